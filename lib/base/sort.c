/* Sorts by a heap (J. W. J. Williams, "Algorithm 232: Heapsort", Commun. ACM 7 (1964) 347): no memory, no bad case. */
#include "base/sort.h"

typedef struct heap_order {
    unsigned char *elements;
    size_t size;
    int (*compare)(const void *, const void *);
} heap_order;

static unsigned char *element(const heap_order *order, size_t i)
{
    return order->elements + i * order->size;
}

static void exchange(const heap_order *order, size_t i, size_t k)
{
    unsigned char *a = element(order, i);
    unsigned char *b = element(order, k);
    for (size_t byte = 0; byte < order->size; byte++) {
        unsigned char swap = a[byte];
        a[byte] = b[byte];
        b[byte] = swap;
    }
}

static int is_before(const heap_order *order, size_t i, size_t k)
{
    return order->compare(element(order, i), element(order, k)) < 0;
}

/* Lets an element sink until none below it is greater. */
static void sift(const heap_order *order, size_t root, size_t count)
{
    for (size_t child = 2 * root + 1; child < count; root = child, child = 2 * root + 1) {
        if (child + 1 < count && is_before(order, child, child + 1))
            child++;
        if (!is_before(order, root, child))
            return;
        exchange(order, root, child);
    }
}

void snow_sort(void *elements, size_t count, size_t size, int (*compare)(const void *, const void *))
{
    heap_order order = {elements, size, compare};
    for (size_t i = count / 2; i > 0; i--)
        sift(&order, i - 1, count);
    for (size_t i = count; i > 1; i--) {
        exchange(&order, 0, i - 1);
        sift(&order, 0, i - 1);
    }
}
