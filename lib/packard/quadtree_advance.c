#include "packard/quadtree_nodes.h"

static quadtree_ref base_result(snow_quadtree *tree, uint32_t index)
{
    quadtree_base cells = snow_quadtree_base_cells(tree, index);
    /* The middle of 9 by 9 in 17 by 17 cells can be told 4 steps ahead. */
    int steps = 1 << (tree->exponent < 2 ? tree->exponent : 2);
    for (int step = 0; step < steps; step++) {
        quadtree_base next = snow_quadtree_base_step(&cells, tree->rule_masks);
        if (step == 0 && memcmp(&next, &cells, sizeof next) == 0) {
            *quadtree_state(tree, index) |= QUADTREE_STILL;
            break;
        }
        cells = next;
    }
    quadtree_leaf leaf = snow_quadtree_base_part(&cells, 4, 4);
    return snow_quadtree_find_leaf(tree, &leaf);
}

/* The quadrants' quadrants, row by row. */
typedef struct quarters {
    quadtree_ref at[4][4];
} quarters;

static quarters quarters_of(const snow_quadtree *tree, const quadtree_ref child[4])
{
    quarters quarter;
    for (int i = 0; i < 4; i++) {
        quadtree_ref part[4];
        quadtree_split(tree, child[i], part);
        for (int j = 0; j < 4; j++)
            quarter.at[i / 2 * 2 + j / 2][i % 2 * 2 + j % 2] = part[j];
    }
    return quarter;
}

quadtree_ref snow_quadtree_middle(snow_quadtree *tree, int level, quadtree_ref ref)
{
    if (level == QUADTREE_BASE_LEVEL) {
        quadtree_base cells = snow_quadtree_base_cells(tree, quadtree_index(ref));
        quadtree_leaf leaf = snow_quadtree_base_part(&cells, 4, 4);
        quadtree_ref middle = snow_quadtree_find_leaf(tree, &leaf);
        return middle == QUADTREE_NONE ? middle : quadtree_turned(middle, quadtree_turn_of(ref));
    }
    quadtree_ref child[4];
    quadtree_split(tree, ref, child);
    quarters quarter = quarters_of(tree, child);
    quadtree_ref middle[4] = {quarter.at[1][1], quarter.at[1][2], quarter.at[2][1], quarter.at[2][2]};
    return snow_quadtree_join(tree, level - 1, middle);
}

static quadtree_ref find_result(snow_quadtree *tree, int level, uint32_t index);

/* The middle half of a pattern, 2^(level − 2) steps later, but at most 2^exponent. */
static inline quadtree_ref result_of(snow_quadtree *tree, int level, quadtree_ref ref)
{
    uint32_t index = quadtree_index(ref);
    quadtree_ref result = quadtree_at(tree, index)->result;
    if (result == QUADTREE_NONE) {
        result = find_result(tree, level, index);
        if (result == QUADTREE_NONE)
            return QUADTREE_NONE;
    }
    return quadtree_turned(result, quadtree_turn_of(ref));
}

static bool is_still(const snow_quadtree *tree, quadtree_ref ref)
{
    return *quadtree_state(tree, quadtree_index(ref)) & QUADTREE_STILL;
}

/* The pattern at (x, y) of a square of patterns, with its neighbours to the right and below. */
static quadtree_wanted want_window(const snow_quadtree *tree, const quadtree_ref *square, int width, int x, int y)
{
    const quadtree_ref *above = square + (ptrdiff_t)y * width + x;
    const quadtree_ref *below = above + width;
    return snow_quadtree_want(tree, (quadtree_ref[4]){above[0], above[1], below[0], below[1]});
}

/* Nine parts that overlap by half: what stands in their middles, now or after
   half the time. They cover the pattern inside its rim, so it is still when they
   are. False: no memory. The results are held. */
static bool first_half(snow_quadtree *tree, int level, const quadtree_ref child[4], const quarters *quarter,
                       quadtree_ref half[3][3], bool *still)
{
    bool moves = level - 2 <= tree->exponent;
    *still = moves;
    quadtree_wanted wanted[3][3];
    for (int i = 1; i < 9; i += 2)
        wanted[i / 3][i % 3] = want_window(tree, quarter->at[0], 4, i % 3, i / 3);
    wanted[1][1] = want_window(tree, quarter->at[0], 4, 1, 1);
    for (int i = 1; i < 9; i += 2)
        snow_quadtree_approach(tree, &wanted[i / 3][i % 3]);
    snow_quadtree_approach(tree, &wanted[1][1]);
    for (int y = 0; y < 3; y++) {
        for (int x = 0; x < 3; x++) {
            quadtree_ref part = x != 1 && y != 1 ? child[y + x / 2]
                                                 : snow_quadtree_get_wanted(tree, level - 1, &wanted[y][x]);
            if (part == QUADTREE_NONE)
                return false;
            half[y][x] = moves ? result_of(tree, level - 1, part) : snow_quadtree_middle(tree, level - 1, part);
            if (half[y][x] == QUADTREE_NONE)
                return false;
            *still = *still && is_still(tree, part);
            quadtree_hold(tree, level - 2, half[y][x]);
        }
    }
    return true;
}

/* The four overlapping quadrants of what the nine parts became, half the time later. */
static quadtree_ref second_half(snow_quadtree *tree, int level, quadtree_ref half[3][3])
{
    quadtree_wanted wanted[4];
    quadtree_ref result[4];
    for (int i = 0; i < 4; i++)
        wanted[i] = want_window(tree, half[0], 3, i % 2, i / 2);
    for (int i = 0; i < 4; i++)
        snow_quadtree_approach(tree, &wanted[i]);
    for (int i = 0; i < 4; i++) {
        quadtree_ref part = snow_quadtree_get_wanted(tree, level - 1, &wanted[i]);
        result[i] = part == QUADTREE_NONE ? part : result_of(tree, level - 1, part);
        if (result[i] == QUADTREE_NONE)
            return QUADTREE_NONE;
        quadtree_hold(tree, level - 2, result[i]);
    }
    return snow_quadtree_join(tree, level - 1, result);
}

static quadtree_ref later_middle(snow_quadtree *tree, int level, uint32_t index)
{
    const quadtree_node *node = quadtree_at(tree, index);
    quarters quarter = quarters_of(tree, node->child);
    quadtree_ref middle[4] = {quarter.at[1][1], quarter.at[1][2], quarter.at[2][1], quarter.at[2][2]};
    quadtree_ref half[3][3];
    bool still = *quadtree_state(tree, index) & QUADTREE_STILL;
    if (!still && !first_half(tree, level, node->child, &quarter, half, &still))
        return QUADTREE_NONE;
    if (!still)
        return second_half(tree, level, half);
    /* What comes in from the rim does not reach the middle. */
    *quadtree_state(tree, index) |= QUADTREE_STILL;
    return snow_quadtree_join(tree, level - 1, middle);
}

/* Finds the result of a node and keeps it there. */
static quadtree_ref find_result(snow_quadtree *tree, int level, uint32_t index)
{
    size_t held = tree->live_count;
    tree->work++;
    quadtree_hold(tree, level, index);
    quadtree_ref result = level == QUADTREE_BASE_LEVEL ? base_result(tree, index) : later_middle(tree, level, index);
    quadtree_at(tree, index)->result = result;
    tree->live_count = held;
    return result;
}

/* Results of 2^exponent steps from now on: forgets those of high levels that are not. */
static void set_exponent(snow_quadtree *tree, int exponent)
{
    enum { LOOKS = 20 /* at nodes, take as long as finding a result */ };
    int same = (exponent < tree->exponent ? exponent : tree->exponent) + 2 - QUADTREE_LEAF_LEVEL;
    if (exponent != tree->exponent) {
        tree->work += tree->next_fresh / LOOKS;
        for (uint32_t index = 1; index < tree->next_fresh; index++) {
            int height = *quadtree_state(tree, index) & QUADTREE_HEIGHT;
            if (height > same && height > 0 && height != QUADTREE_FREE)
                quadtree_at(tree, index)->result = QUADTREE_NONE;
        }
    }
    tree->exponent = exponent;
}

/* Takes the crystal 2^exponent steps further. */
static bool leap(snow_quadtree *tree, int exponent)
{
    quadtree_crystal *now = &tree->now;
    int64_t steps = INT64_C(1) << exponent;
    set_exponent(tree, exponent);
    int level = QUADTREE_LEAST_ROOT;
    while ((now->reach + steps) >> (level - 2) != 0)
        level++;
    if (!snow_quadtree_grow(tree, level))
        return false;
    quadtree_ref result = result_of(tree, now->level, now->root);
    if (result == QUADTREE_NONE)
        return false;
    now->root = result;
    now->level--;
    now->reach += steps;
    return true;
}

snow_status snow_quadtree_advance(snow_quadtree *tree, uint64_t steps)
{
    quadtree_crystal before = tree->now;
    if (before.root == tree->empty[before.level] || steps == 0)
        return SNOW_OK;
    if (steps > (uint64_t)(SNOW_QUADTREE_REACH - before.reach))
        return SNOW_ERROR_TOO_LARGE;
    tree->collections = 0;
    quadtree_hold(tree, before.level, before.root);
    bool done = true;
    for (int exponent = 0; done && steps >> exponent != 0; exponent++)
        done = (steps >> exponent & 1) == 0 || leap(tree, exponent);
    done = done && snow_quadtree_find_measures(tree);
    tree->live_count = 0;
    if (!done)
        tree->now = before;
    return done ? SNOW_OK : tree->failure;
}

/* Looks for a cell inside the rim that freezes in the next step; remembers where there is none. */
static bool find_still(snow_quadtree *tree, int level, quadtree_ref ref)
{
    uint32_t index = quadtree_index(ref);
    if (is_still(tree, ref))
        return true;
    size_t held = tree->live_count;
    quadtree_hold(tree, level, ref);
    bool still = true;
    if (level == QUADTREE_BASE_LEVEL) {
        quadtree_base cells = snow_quadtree_base_cells(tree, index);
        quadtree_base next = snow_quadtree_base_step(&cells, tree->rule_masks);
        still = memcmp(&next, &cells, sizeof next) == 0;
    } else {
        quarters quarter = quarters_of(tree, quadtree_at(tree, index)->child);
        for (int i = 0; still && i < 9; i++) {
            quadtree_wanted wanted = want_window(tree, quarter.at[0], 4, i % 3, i / 3);
            quadtree_ref part = snow_quadtree_get_wanted(tree, level - 1, &wanted);
            still = part != QUADTREE_NONE && find_still(tree, level - 1, part);
        }
    }
    tree->live_count = held;
    if (still)
        *quadtree_state(tree, index) |= QUADTREE_STILL;
    return still;
}

bool snow_quadtree_is_still(snow_quadtree *tree)
{
    const quadtree_crystal *now = &tree->now;
    tree->collections = 0;
    /* The next cells must be inside the root's rim. */
    bool has_space = (now->reach + 1) >> (now->level - 1) == 0 || snow_quadtree_grow(tree, now->level + 1);
    return has_space && find_still(tree, now->level, now->root);
}
