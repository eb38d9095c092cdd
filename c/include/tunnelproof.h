/* tunnelproof: continuous collision detection of two moving edges, and of a moving vertex and face,
 * without thresholds: no hit is false, no contact is missed, and the time of impact is the exact
 * one rounded down.
 *
 * The proofs assume rounding to nearest and gradual underflow in the thread that calls, which is
 * what C sets up. A program that is linked with -ffast-math, or sets FTZ or DAZ, has no gradual
 * underflow: restore it around the call.
 *
 * The points of a query are 24 numbers in metres: x, y, z of A, B, C, D at the start of the step,
 * then of A, B, C, D at its end. In between they move on straight lines. Edge-edge: the edges AB
 * and CD. Vertex-face: the vertex A and the face BCD. The first side is the edge AB or the vertex
 * A, the second is the edge CD or the face BCD. The radius of a query is the exact sum of two
 * numbers, such as the radii of two wires. Contact is a distance of at most the radius; with radius
 * 0, a common point.
 *
 * All functions may be called from any thread at any time. None keeps a pointer. */
#ifndef TUNNELPROOF_H
#define TUNNELPROOF_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The verdict on a query: no contact in the step, or contact. */
#define TUNNELPROOF_MISS 0
#define TUNNELPROOF_HIT 1
/* Or why there is none: a pointer that must not be null is null, a coordinate is NaN or
 * infinite, a radius is NaN, infinite or negative. */
#define TUNNELPROOF_NULL (-1)
#define TUNNELPROOF_NOT_FINITE (-2)
#define TUNNELPROOF_RADIUS (-3)

/* Whether a simulator that misses the contact lets the two sides through each other (a crossing)
 * or not (a graze). */
enum tunnelproof_kind {
  TUNNELPROOF_CROSSING = 1,
  TUNNELPROOF_GRAZE = 2
};

/* How the two sides move against each other during the whole step. Of several, the last in this
 * list. */
enum tunnelproof_case {
  /* None of those below. */
  TUNNELPROOF_GENERAL = 1,
  /* All four points share a plane for the whole step. */
  TUNNELPROOF_COPLANAR = 2,
  /* The edges are parallel for the whole step, on two lines. */
  TUNNELPROOF_PARALLEL = 3,
  /* All four points of two edges share a line for the whole step. */
  TUNNELPROOF_COLLINEAR = 4,
  /* A and C, of two edges, are the same point for the whole step. */
  TUNNELPROOF_SHARED_START = 5,
  /* An edge is a point, or the face has no area, for the whole step. */
  TUNNELPROOF_DEGENERATE = 6
};

/* A point of contact. */
typedef struct tunnelproof_contact_point {
  /* The weights of A, B, C and D, in [0, 1]. Of two edges they are 1 - u, u, 1 - v, v with u on
   * AB and v on CD. Of a vertex and a face they are 1 and the weights of B, C and D. */
  double weights[4];
  /* The point on the first side at toi, in metres. */
  double point[3];
} tunnelproof_contact_point;

/* The first contact of a step, of either kind of query. */
typedef struct tunnelproof_hit {
  /* The largest double that is not above the time of impact, in [0, 1], and the smallest that is
   * not below it. Positions that are rounded to double at toi may already be past the contact. */
  double toi, toi_above;
  /* A value of tunnelproof_kind. Exact. */
  int32_t kind;
  /* The sign of f just before the contact, which tells the side they come from; 0 if f is always
   * 0, or at time 0. Exact. Of two edges f = ((B - A) x (D - C)) . (C - A), of a vertex and a
   * face f = ((C - B) x (D - B)) . (A - B). */
  int32_t side;
  /* A value of tunnelproof_case. Exact. */
  int32_t motion_case;
  /* Whether the edges are parallel at the time of impact, or the face is a segment, though not
   * for the whole step. */
  int32_t temporarily_parallel;
  /* Whether an edge, or the face, is a point at the time of impact, though not for the whole
   * step. */
  int32_t temporarily_point;
  /* Whether two edges touch, or are nearest, along a segment: from `first` to `second`. */
  int32_t has_second;
  /* Where they touch, or with a radius are nearest. `second` repeats `first` unless has_second. */
  tunnelproof_contact_point first, second;
  /* Neither u, v nor a weight of B, C, D of a face is farther from the exact one than this,
   * which is at most 2^-32. */
  double place_error;
  /* The unit vector along which they touch, from the first side to the second as they are just
   * before the contact. 0, 0, 0 where there is none: they share a point at the start of the
   * step. */
  double normal[3];
  /* The distance of `normal` from the exact one is at most this. */
  double normal_error;
} tunnelproof_hit;

/* Decides one query. Returns TUNNELPROOF_MISS, TUNNELPROOF_HIT, or why it cannot be decided.
 * `radii` are two numbers, or NULL for radius 0. `hit` is written where the verdict is
 * TUNNELPROOF_HIT, and may be NULL. */
int32_t tunnelproof_decide_edge_edge(const double *points, const double *radii,
                                     tunnelproof_hit *hit);
int32_t tunnelproof_decide_vertex_face(const double *points, const double *radii,
                                       tunnelproof_hit *hit);

/* Decides `count` queries. Their points follow one another, and so do their radii unless `radii` is
 * NULL. `verdicts[i]` gets the verdict on query i. Where it is TUNNELPROOF_HIT, `hits[i]` gets the
 * contact, unless `hits` is NULL. The other elements of `hits` stay as they are. Returns the number
 * of hits, or TUNNELPROOF_NULL.
 *
 * The answers are those of the functions above, bit for bit. Where few queries are hits this is
 * faster. */
int64_t tunnelproof_decide_edge_edge_batch(const double *points, const double *radii, size_t count,
                                           int32_t *verdicts, tunnelproof_hit *hits);
int64_t tunnelproof_decide_vertex_face_batch(const double *points, const double *radii,
                                             size_t count, int32_t *verdicts,
                                             tunnelproof_hit *hits);

/* The version of the library, "0.1.0". */
const char *tunnelproof_version(void);

#ifdef __cplusplus
}
#endif

#endif
