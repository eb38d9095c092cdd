/*
 * What a shared library offers to be judged: tunnelproof certify --subject lib:./libmy_ccd.so
 *
 * It defines some of the functions below. They are called in a process of their own, one at a time, from one
 * thread; several such processes run at once. A crash is counted as no answer to that query. What they write to the
 * standard output goes to the standard error.
 */
#ifndef TUNNELPROOF_SUBJECT_H
#define TUNNELPROOF_SUBJECT_H

#ifdef __cplusplus
extern "C" {
#endif

#if defined(_WIN32)
#define TUNNELPROOF_EXPORT __declspec(dllexport)
#elif defined(__GNUC__)
#define TUNNELPROOF_EXPORT __attribute__((visibility("default")))
#else
#define TUNNELPROOF_EXPORT
#endif

/* What is answered. */
#define TUNNELPROOF_MISS 0
#define TUNNELPROOF_HIT 1
/* Queries of this kind, or with this radius, are not taken. */
#define TUNNELPROOF_UNSUPPORTED 2

/*
 * Whether two edges touch, and when. points: x y z of A B C D at the start of the step, then x y z of A B C D at its
 * end, in metres; AB is one edge, CD the other; each point moves on a straight line. radius: contact is a distance of at
 * most the exact sum of the two, 0 and 0 in most families. toi: for a hit, set to the time of impact, from 0 to 1.
 */
TUNNELPROOF_EXPORT int tunnelproof_edge_edge(const double points[24], const double radius[2], double *toi);

/* The same of a vertex A and a face BCD. */
TUNNELPROOF_EXPORT int tunnelproof_vertex_face(const double points[24], const double radius[2], double *toi);

/*
 * The same where bodies turn. A body is points in its own frame (local) and two poses: x y z of its centre and w x y z of a
 * quaternion, at the start of the step and at its end, by a turn of at most 90 degrees. In between, centre and quaternion each move on a
 * straight line; the quaternion is taken for the orientation of its direction, and with the sign at the end that makes the turn
 * the shorter one. It need not have length 1. radius and toi: as above.
 */

/* An edge AB, by its ends at the start and at the end, and an edge of a body. */
TUNNELPROOF_EXPORT int tunnelproof_edge_turning_edge(const double points[12], const double local[6], const double poses[14],
                                                     const double radius[2], double *toi);

/* A vertex A, at the start and at the end, and a face of a body. */
TUNNELPROOF_EXPORT int tunnelproof_vertex_turning_face(const double points[6], const double local[9], const double poses[14],
                                                       const double radius[2], double *toi);

/* An edge of one body and an edge of another one. local: the ends of the first, then of the second; poses: the same. */
TUNNELPROOF_EXPORT int tunnelproof_turning_edge_turning_edge(const double local[12], const double poses[28],
                                                             const double radius[2], double *toi);

/* A vertex of one body and a face of another one. */
TUNNELPROOF_EXPORT int tunnelproof_turning_vertex_turning_face(const double local[12], const double poses[28],
                                                               const double radius[2], double *toi);

/* The shapes of a cast. */
#define TUNNELPROOF_SPHERE 0
#define TUNNELPROOF_SEGMENT 1
#define TUNNELPROOF_TRIANGLE 2
#define TUNNELPROOF_BOX 3

/*
 * Whether two convex bodies that are translated touch, one of them a box: for certify-boxes. bodies: of each body x y z of four
 * points at the start of the step, and of its translation. A sphere has the first point, a segment the first two, a triangle three;
 * a box has a corner and the three corners beside it. radius: by how much a sphere or a segment is larger.
 */
TUNNELPROOF_EXPORT int tunnelproof_box_cast(const int shapes[2], const double bodies[30], const double radius[2], double *toi);

#ifdef __cplusplus
}
#endif

#endif
