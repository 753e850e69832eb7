#include "common/label.h"

#include "common/message.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/*
 * A glyph is a list of pen strokes with blanks between them; a stroke is a list
 * of points, a letter for x and a digit for y. Capital letters are points on
 * the stroke, small ones are control points of quadratic curves, with a point
 * on the stroke halfway between two of them, as in TrueType outlines. Capitals
 * reach from y = 0 to the base line y = 8; descenders end at y = ';' (11).
 */
static const char *const digits[] = {
    "C0e0e8a8a0C0", "A2C0C8", "A2a0C0e0E2e4A8E8", "A1b0C0e0E2e4C4e4E6e8C8b8A7", "D8D0A6E6",
    "E0A0A4b3C3e3e8C8b8A7", "D0a1A5a8C8e8e3C3a3A5", "A0E0B8", "C0e0E2e4C4a4A6a8C8e8E6e4C4a4A2a0C0",
    "B8e7E3e0C0a0a5C5e5E3",
};

static const char *const small_letters[] = {
    "E5e3C3a3a8C8e8E6 E3E8", "A0A8 A5a3C3e3e8C8a8A6", "E4d3C3a3a8C8d8E7", "E0E8 E5e3C3a3a8C8e8E6",
    "A5E5e3C3a3a8C8d8E7", "D0b0B2B8 A3D3", "E5e3C3a3a8C8e8E6 E3E9e;C;b;A:", "A0A8 A5a3C3e3E5E8", "A3A8 A1A1",
    "B3B9b;A; B1B1", "A0A8 E3A6 B5E8", "A0A8", "A3A8 A5a3d3D5D8 D5d3g3G5G8", "A3A8 A5a3C3e3E5E8",
    "C3e3e8a8a3C3", "A3A; A5a3C3e3e8C8a8A6", "E3E; E5e3C3a3a8C8e8E6", "A3A8 A5a3D3", "E4d3C3a3a5e6e8C8b8A7",
    "B1B7b8D8 A3D3", "A3A6a8C8e8E6 E3E8", "A3C8E3", "A3B8D4F8G3", "A3E8 E3A8", "A3C8 E3B;", "A3E3A8E8",
};

static const char *const capital_letters[] = {
    "A8C0E8 B5D5", "A0A8C8e8E6e4C4A4 A0C0e0E2e4C4", "E1d0C0a0a8C8d8E7", "A0A8B8e8E4e0B0A0", "E0A0A8E8 A4D4",
    "E0A0A8 A4D4", "E1d0C0a0a8C8e8E6E4C4", "A0A8 E0E8 A4E4", "A0A8", "D0D6d8B8a8A6", "A0A8 E0A5 B4E8", "A0A8E8",
    "A8A0D5G0G8", "A8A0E8E0", "D0g0g8a8a0D0", "A8A0C0e0E2e4C4A4", "D0g0g8a8a0D0 E6G8", "A8A0C0e0E2e4C4A4 C4E8",
    "E1d0C0a0A2a4C4e4E6e8C8b8A7", "A0E0 C0C8", "A0A6a8C8e8E6E0", "A0C8E0", "A0B8D2F8G0", "A0E8 E0A8",
    "A0C4E0 C4C8", "A0E0A8E8",
};

static const char *const greek_letters[] = {
    "F3e8C8a8a3C3e3F8", "A;A2a0C0e0E2e4C4 C4e4E6e8C8a8A6", "A3b3C8 E3C8C;",
};

static const struct {
    char sign;
    const char *glyph;
} signs[] = {
    {' ', "C9"}, {'.', "A8A8"}, {',', "B8A:"}, {'-', "A5D5"}, {'=', "A4E4 A6E6"}, {'+', "C3C7 A5E5"},
    {'(', "C0a4C9"}, {')', "A0c4A9"}, {'/', "A9D0"}, {':', "A4A4 A8A8"}, {';', "B4B4 B8A:"}, {'\'', "A0A2"},
};

enum { BASE_LINE = 8, DEPTH = 11, CURVE_STEPS = 8 };
#define PEN 0.55   /* half the width of a stroke */
#define GAP 2.1    /* between two glyphs */
#define MARGIN 1.0 /* round the text, for pen and soft edges */

typedef struct point {
    double x;
    double y;
} point;

/* The text's own box of coverage, from which it is painted in one go. */
typedef struct ink {
    int32_t width;
    int32_t height;
    double unit; /* pixels */
    double *coverage;
} ink;

/* The next glyph of a UTF-8 text; unknown characters are skipped. */
static const char *next_glyph(const char **text)
{
    unsigned char first = (unsigned char)*(*text)++;
    if (first >= '0' && first <= '9')
        return digits[first - '0'];
    if (first >= 'a' && first <= 'z')
        return small_letters[first - 'a'];
    if (first >= 'A' && first <= 'Z')
        return capital_letters[first - 'A'];
    unsigned char second = (unsigned char)**text;
    if (first == 0xCE && second >= 0xB1 && second <= 0xB3) { /* α, β, γ */
        (*text)++;
        return greek_letters[second - 0xB1];
    }
    for (size_t i = 0; i < sizeof signs / sizeof signs[0]; i++)
        if (signs[i].sign == (char)first)
            return signs[i].glyph;
    return "";
}

static bool is_control(char letter)
{
    return letter >= 'a';
}

static point point_at(const char *code)
{
    return (point){code[0] - (is_control(code[0]) ? 'a' : 'A'), code[1] - '0'};
}

static double glyph_width(const char *glyph)
{
    double width = 0;
    for (const char *code = glyph; *code; code += *code == ' ' ? 1 : 2)
        if (*code != ' ')
            width = fmax(width, point_at(code).x);
    return width;
}

/* In units of the glyphs' coordinates. */
static double text_width(const char *text)
{
    double width = -GAP;
    while (*text)
        width += glyph_width(next_glyph(&text)) + GAP;
    return fmax(width, 0);
}

double label_width(const char *text, double height)
{
    return text_width(text) * height / BASE_LINE;
}

static double distance_to_line(point from, point to, point place)
{
    double dx = to.x - from.x;
    double dy = to.y - from.y;
    double length = dx * dx + dy * dy;
    double share = length > 0 ? ((place.x - from.x) * dx + (place.y - from.y) * dy) / length : 0;
    share = fmin(fmax(share, 0), 1);
    return hypot(place.x - from.x - share * dx, place.y - from.y - share * dy);
}

static int32_t clip(double number, int32_t limit)
{
    return (int32_t)fmin(fmax(number, 0), limit);
}

static void draw_line(const ink *self, point from, point to)
{
    double reach = PEN + 1 / self->unit;
    int32_t left = clip((fmin(from.x, to.x) - reach) * self->unit, self->width);
    int32_t right = clip((fmax(from.x, to.x) + reach) * self->unit + 1, self->width);
    int32_t top = clip((fmin(from.y, to.y) - reach) * self->unit, self->height);
    int32_t bottom = clip((fmax(from.y, to.y) + reach) * self->unit + 1, self->height);
    for (int32_t y = top; y < bottom; y++) {
        for (int32_t x = left; x < right; x++) {
            point place = {(x + 0.5) / self->unit, (y + 0.5) / self->unit};
            double cover = (PEN - distance_to_line(from, to, place)) * self->unit + 0.5;
            double *covered = &self->coverage[(size_t)y * (size_t)self->width + (size_t)x];
            *covered = fmax(*covered, fmin(cover, 1));
        }
    }
}

static void draw_curve(const ink *self, point from, point control, point to)
{
    point last = from;
    for (int i = 1; i <= CURVE_STEPS; i++) {
        double t = (double)i / CURVE_STEPS;
        point next = {(1 - t) * (1 - t) * from.x + 2 * t * (1 - t) * control.x + t * t * to.x,
                      (1 - t) * (1 - t) * from.y + 2 * t * (1 - t) * control.y + t * t * to.y};
        draw_line(self, last, next);
        last = next;
    }
}

static point moved(point place, double dx)
{
    return (point){place.x + dx + MARGIN, place.y + MARGIN};
}

static void draw_glyph(const ink *self, const char *glyph, double dx)
{
    point pen = {0, 0};
    bool down = false;
    for (const char *code = glyph; *code;) {
        if (*code == ' ') {
            down = false;
            code++;
            continue;
        }
        point next = moved(point_at(code), dx);
        bool control = is_control(*code);
        code += 2;
        if (control) {
            point end = moved(point_at(code), dx); /* a stroke never ends in a control point */
            if (is_control(*code))
                end = (point){(next.x + end.x) / 2, (next.y + end.y) / 2};
            else
                code += 2;
            draw_curve(self, pen, next, end);
            next = end;
        } else if (down) {
            draw_line(self, pen, next);
        }
        pen = next;
        down = true;
    }
}

static void paint(picture *self, const ink *text, int32_t left, int32_t top, colour with)
{
    const unsigned char channels[] = {with.red, with.green, with.blue};
    for (int32_t y = 0; y < text->height; y++) {
        for (int32_t x = 0; x < text->width; x++) {
            double cover = text->coverage[(size_t)y * (size_t)text->width + (size_t)x];
            if (cover <= 0 || left + x < 0 || left + x >= self->width || top + y < 0 || top + y >= self->height)
                continue;
            unsigned char *pixel = picture_at(self, left + x, top + y);
            for (int i = 0; i < 3; i++)
                pixel[i] = (unsigned char)lround(pixel[i] + cover * (channels[i] - pixel[i]));
        }
    }
}

void label_draw(picture *self, const char *text, double height, double x, double y, colour with)
{
    double unit = height / BASE_LINE;
    ink box = {(int32_t)((text_width(text) + 2 * MARGIN) * unit) + 2, (int32_t)((DEPTH + 2 * MARGIN) * unit) + 2, unit,
               NULL};
    box.coverage = calloc((size_t)box.width * (size_t)box.height, sizeof *box.coverage);
    if (box.coverage == NULL) {
        complain("no memory for the label '%s'", text);
        return;
    }
    double along = 0;
    for (const char *rest = text; *rest;) {
        const char *glyph = next_glyph(&rest);
        draw_glyph(&box, glyph, along);
        along += glyph_width(glyph) + GAP;
    }
    paint(self, &box, (int32_t)lround(x - MARGIN * unit), (int32_t)lround(y - (BASE_LINE + MARGIN) * unit), with);
    free(box.coverage);
}
