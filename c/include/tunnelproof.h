/* tunnelproof: continuous collision detection of moving edges, and of a moving vertex and face, without thresholds:
 * no hit is false, no contact is missed, and the time of impact is the exact one rounded down.
 *
 * The points of a query are 24 numbers in metres: x, y, z of A, B, C, D at the start of the step, then of A, B, C, D at
 * its end. In between they move on straight lines. Edge-edge: the edges AB and CD. Vertex-face: the vertex A and the face
 * BCD. The radius of a query is the exact sum of two numbers, say of the radii of two wires; contact is a distance of at
 * most the radius. With radius 0, contact is a common point.
 *
 * All functions may be called from any thread at any time; none keeps a pointer. */
#ifndef TUNNELPROOF_H
#define TUNNELPROOF_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What is said of a query. */
enum tunnelproof_verdict {
  TUNNELPROOF_MISS = 0,
  TUNNELPROOF_HIT = 1,
  /* A pointer that must not be null is null. */
  TUNNELPROOF_NULL = -1,
  /* A coordinate is NaN or infinite. */
  TUNNELPROOF_NOT_FINITE = -2,
  /* A radius is NaN, infinite or negative. */
  TUNNELPROOF_RADIUS = -3
};

/* The first contact of two edges. */
typedef struct tunnelproof_edge_hit {
  /* The largest double that is not above the time of impact, in [0, 1], and the smallest that is not below it. */
  double toi, toi_above;
  /* Where they touch, or with a radius where they are nearest: u on AB, v on CD, both in [0, 1]. */
  double u, v;
  /* The other end of the overlap if is_overlap, else the same place again. */
  double second_u, second_v;
  /* No parameter is farther from the exact one than this, which is at most 2^-32. */
  double parameter_error;
  /* Whether the edges swap sides if the contact is missed (1) or only graze each other (0). */
  int32_t crosses;
  /* The sign of ((B - A) x (D - C)) . (C - A) just before the contact; 0 if it is always 0, or at time 0. */
  int32_t side;
  /* Whether they touch, or are nearest, along a segment. */
  int32_t is_overlap;
} tunnelproof_edge_hit;

/* The first contact of a vertex and a face. */
typedef struct tunnelproof_face_hit {
  double toi, toi_above;
  /* Where on the face: the weights of B, C and D, in [0, 1]. */
  double weights[3];
  /* No weight is farther from the exact one than this, which is at most 2^-32. */
  double weight_error;
  int32_t crosses;
  /* The sign of ((C - B) x (D - B)) . (A - B) just before the contact; 0 if it is always 0, or at time 0. */
  int32_t side;
} tunnelproof_face_hit;

/* Decides one query: a value of tunnelproof_verdict. `radii` are two numbers, or NULL for radius 0. `hit` is written where
 * the verdict is TUNNELPROOF_HIT, and may be NULL. */
int32_t tunnelproof_edge_edge(const double *points, const double *radii, tunnelproof_edge_hit *hit);
int32_t tunnelproof_vertex_face(const double *points, const double *radii, tunnelproof_face_hit *hit);

/* Decides `count` queries, whose points follow one another, as their radii do unless `radii` is NULL. `verdicts` gets a value of
 * tunnelproof_verdict for each, `hits[i]`, unless `hits` is NULL, the contact where verdict i is TUNNELPROOF_HIT; other
 * elements are left alone. Returns the number of hits, or TUNNELPROOF_NULL. Where few queries are hits this is faster than one by one.
 */
int64_t tunnelproof_edge_edge_batch(const double *points, const double *radii, size_t count, int32_t *verdicts,
                                    tunnelproof_edge_hit *hits);
int64_t tunnelproof_vertex_face_batch(const double *points, const double *radii, size_t count, int32_t *verdicts,
                                      tunnelproof_face_hit *hits);

/* The version of the library, "0.1.0". */
const char *tunnelproof_version(void);

#ifdef __cplusplus
}
#endif

#endif
