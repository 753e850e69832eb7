/* Brownian motion that comes back from far away. */
#ifndef SNOW_AGGREGATE_CIRCLE_H
#define SNOW_AGGREGATE_CIRCLE_H

#include "aggregate/stream.h"

/* Where Brownian motion from a point outside first meets the circle of this radius round the origin, as a
   direction: the uniform circle moved by the automorphism of the disc that takes 0 to the point's mirror image. */
static inline snow_direction snow_circle_hit(snow_stream *stream, double x, double y, double radius)
{
    snow_direction u = snow_stream_direction(stream);
    double square = x * x + y * y;
    double ax = radius * x / square;
    double ay = radius * y / square;
    double top_x = u.x + ax;
    double top_y = u.y + ay;
    double bottom_x = 1 + ax * u.x + ay * u.y;
    double bottom_y = ax * u.y - ay * u.x;
    double bottom = bottom_x * bottom_x + bottom_y * bottom_y;
    return (snow_direction){(top_x * bottom_x + top_y * bottom_y) / bottom,
                            (top_y * bottom_x - top_x * bottom_y) / bottom};
}

#endif
