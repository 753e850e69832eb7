/* Clusters that drift in a periodic box: where their particles are, and which merge. */
#ifndef SNOW_AGGREGATE_CLUSTERS_H
#define SNOW_AGGREGATE_CLUSTERS_H

#include "aggregate/box.h"
#include "aggregate/shape.h"

/* What a move looks at: one line of cache. */
typedef struct cluster {
    uint32_t mass;  /* 0: it is gone */
    uint32_t first; /* of its members in the list of members */
    shape *shape;   /* of a large cluster that has moved since it grew */
    snow_site origin;   /* what is added to its particles' positions; least + origin lies in the box */
    snow_site least;    /* of its particles' positions */
    snow_site greatest;
    uint32_t capacity; /* members that have room in the list */
    uint32_t place;    /* in the list of clusters that live */
    uint32_t rank;     /* in the list of large clusters */
} cluster;

typedef struct cluster_measures {
    int64_t sum[3];   /* of its particles' positions */
    uint64_t squares; /* of their lengths */
    double drag;      /* mass^mobility: moves are the rarer the greater it is */
} cluster_measures;

/* Small clusters mark their sites and move site by site; large ones are looked for, and move by their shapes. */
enum { SNOW_LARGE_CLUSTER = 12 };

typedef struct clusters {
    torus box;
    uint32_t particles;
    uint32_t *owner;     /* by site of the box: 1 + the small cluster there */
    snow_site *position; /* by particle; the cluster's origin is to be added; not wrapped */
    uint32_t *home;      /* by particle: its cluster */
    uint32_t *member;    /* particles, cluster by cluster, with gaps */
    uint32_t *spare;     /* as much again, to close the gaps */
    uint32_t filled;     /* of member */
    cluster *cluster;    /* by number */
    cluster_measures *measures;
    uint32_t *live;      /* the clusters that there are */
    uint32_t lives;
    uint32_t *large;
    uint32_t larges;
    uint32_t *touched; /* clusters that a move has come to touch, ascending */
    uint32_t largest;  /* mass */
    double least_drag; /* no cluster that there is has less; it follows them now and then */
    uint32_t merged;   /* mergings since it last did */
    snow_site *scratch; /* sites of a cluster */
    snow_site *hit;     /* sites that a move has come to touch */
    size_t hits;
    shape_maker maker;
    struct snow_gaps *gaps; /* gaps.c; NULL: not yet */
    bool stale; /* the box's bits are older than the last moves */
} clusters;

snow_status snow_clusters_start(clusters *self, snow_heap *heap, uint32_t particles, double density, int axes);
void snow_clusters_end(clusters *self, snow_heap *heap);

/* A cluster of one particle on an empty site of the box. */
void snow_clusters_add(clusters *self, uint32_t particle, snow_site site);

/* The cluster on a site of the box, 1 + its number; 0: none. */
uint32_t snow_clusters_at(const clusters *self, snow_site site);

/* The site of the box where a position of a cluster lies. */
snow_site snow_clusters_site(const clusters *self, const cluster *of, snow_site position);

/* Moves a cluster one step, if nothing is in its way. Lists in `touched` the clusters that it then
   touches with its front, or that were in the way; *count: how many. `may_rest`: clusters that touch can be
   apart, so that something may be in the way. */
snow_status snow_clusters_move(clusters *self, snow_heap *heap, uint32_t number, int direction, bool may_rest,
                               uint32_t *count);

/* The same where the gaps between few clusters are known; the box's bits and owners are left behind, the
   bits until some touch. */
snow_status snow_clusters_move_few(clusters *self, snow_heap *heap, uint32_t number, int direction, uint32_t *count);

/* The box's bits follow the clusters again. */
void snow_clusters_show(clusters *self);

/* Puts a cluster's sites into a set of sites, or takes them out. */
void snow_clusters_flip(const clusters *self, const cluster *of, const torus *set);

/* Adds a cluster to the list of those that are touched, once; returns how many there are. */
uint32_t snow_clusters_list(clusters *self, uint32_t count, uint32_t number);

/* Lists the clusters that a single particle touches; returns how many. */
uint32_t snow_clusters_find_neighbours(clusters *self, uint32_t number);

/* Makes one of two clusters that touch; returns its number. */
uint32_t snow_clusters_merge(clusters *self, snow_heap *heap, uint32_t a, uint32_t b, double mobility);

/* For a saved grid: a cluster without particles, then those, each on an empty site, then that it is complete. */
cluster *snow_clusters_open(clusters *self, uint32_t number, uint32_t mass, snow_site origin, double mobility);
void snow_clusters_count(clusters *self, cluster *to, uint32_t particle);
void snow_clusters_close(clusters *self, cluster *it);

#endif
