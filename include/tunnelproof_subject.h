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
