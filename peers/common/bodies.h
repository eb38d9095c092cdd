/*
 * A query as two rigid bodies that are cast: each by the translation of its first point. The points of a query are those
 * of tunnelproof_subject.h: x y z of A B C D at the start of the step, then at its end.
 */
#ifndef PEERS_BODIES_H
#define PEERS_BODIES_H

#include <math.h>
#include <stdlib.h>

#include "tunnelproof_subject.h"

/* How much larger the first body is asked to be: the value of PEERS_SKIN, in metres. */
static double peers_skin(void) {
    static double skin = -1;
    if (skin < 0) {
        const char *text = getenv("PEERS_SKIN");
        skin = text ? atof(text) : 0;
    }
    return skin;
}

static void peers_step(const double points[24], int point, double step[3]) {
    for (int k = 0; k < 3; k++) step[k] = points[12 + 3 * point + k] - points[3 * point + k];
}

/* The middle of an edge, half its length, and the rotation (x y z w) that takes an axis (0 to 2) along it. */
struct peers_capsule {
    double centre[3], half, rotation[4];
};

static struct peers_capsule peers_capsule(const double points[24], int first, int axis) {
    const double *a = points + 3 * first, *b = a + 3;
    struct peers_capsule capsule;
    double along[3], length = 0;
    for (int k = 0; k < 3; k++) {
        capsule.centre[k] = a[k] + 0.5 * (b[k] - a[k]);
        along[k] = b[k] - a[k];
        length += along[k] * along[k];
        capsule.rotation[k] = 0;
    }
    length = sqrt(length);
    capsule.half = 0.5 * length;
    capsule.rotation[3] = 1;
    if (length == 0) return capsule;
    double sign = along[axis] < 0 ? -1 : 1;
    for (int k = 0; k < 3; k++) along[k] *= sign / length;
    /* Half way between the axis and the edge: the cross product of both, and 1 and their cosine. */
    int next = (axis + 1) % 3, last = (axis + 2) % 3;
    double w = 1 + along[axis], norm = sqrt(w * w + along[next] * along[next] + along[last] * along[last]);
    capsule.rotation[next] = -along[last] / norm;
    capsule.rotation[last] = along[next] / norm;
    capsule.rotation[3] = w / norm;
    return capsule;
}

/* A body of a cast of a box: its shape, points and translation as in tunnelproof_subject.h, and by how much it is larger. */
struct peers_body {
    int shape;
    const double *points, *step;
    double radius;
};

/* Its points at both ends of the step where a query has them: A B of a segment, A of a sphere, B C D of a triangle. */
static void peers_query_points(const struct peers_body *body, double points[24]) {
    int first = body->shape == TUNNELPROOF_TRIANGLE ? 1 : 0;
    for (int i = 0; i < 9; i++) {
        points[3 * first + i] = body->points[i];
        points[12 + 3 * first + i] = body->points[i] + body->step[i % 3];
    }
}

/* Both bodies. The skin is that of the first body with a radius or, without one, of the first box. */
static void peers_bodies(const int shapes[2], const double bodies[30], const double radius[2], struct peers_body both[2]) {
    for (int i = 0; i < 2; i++) {
        struct peers_body body = {shapes[i], bodies + 15 * i, bodies + 15 * i + 12, radius[i]};
        both[i] = body;
    }
    int round = radius[0] > 0 ? 0 : radius[1] > 0 ? 1 : -1;
    both[round >= 0 ? round : shapes[0] == TUNNELPROOF_BOX ? 0 : 1].radius += peers_skin();
}

/* Corner `number` of a box: bit i says whether it is at the far end of side i. A box that is asked larger has longer sides. */
static void peers_corner(const struct peers_body *box, int number, double corner[3]) {
    const double *p = box->points;
    for (int k = 0; k < 3; k++) corner[k] = p[k];
    for (int side = 0; side < 3; side++) {
        double along[3], length = 0;
        for (int k = 0; k < 3; k++) {
            along[k] = p[3 * (side + 1) + k] - p[k];
            length += along[k] * along[k];
        }
        int far = number >> side & 1;
        /* Without a skin nothing is rounded. */
        double by = box->radius > 0 ? box->radius / sqrt(length) : 0;
        for (int k = 0; k < 3; k++) corner[k] += far ? along[k] + by * along[k] : -by * along[k];
    }
}

/* A body that turns: its points in its own frame, and its poses at both ends of the step. */
struct peers_turning {
    const double *local;
    int count;
    double centres[2][3], quaternions[2][4]; /* x y z w, of length 1; of both signs the one that makes the turn short */
    double radius;
};

/* `local` and `poses` are those of tunnelproof_subject.h; the first body has `count` points, the other the rest. */
static void peers_turning(const double local[12], const double poses[28], int count, const double radius[2],
                          struct peers_turning both[2]) {
    for (int i = 0; i < 2; i++) {
        struct peers_turning *body = &both[i];
        double along = 0;
        body->local = local + (i ? 3 * count : 0);
        body->count = i ? 4 - count : count;
        body->radius = radius[i] + (i ? 0 : peers_skin());
        for (int end = 0; end < 2; end++) {
            const double *pose = poses + 14 * i + 7 * end, *q = pose + 3;
            double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
            for (int k = 0; k < 3; k++) body->centres[end][k] = pose[k];
            for (int k = 0; k < 4; k++) body->quaternions[end][k] = q[(k + 1) % 4] / length;
        }
        for (int k = 0; k < 4; k++) along += body->quaternions[0][k] * body->quaternions[1][k];
        for (int k = 0; k < 4; k++)
            if (along < 0) body->quaternions[1][k] = -body->quaternions[1][k];
    }
}

/* The middle of a box along the axes and half of its sides. Returns 0 for a box that is turned. */
static int peers_aligned(const struct peers_body *box, double centre[3], double half[3]) {
    for (int k = 0; k < 3; k++) centre[k] = box->points[k], half[k] = 0;
    for (int side = 0; side < 3; side++) {
        int axes = 0;
        for (int k = 0; k < 3; k++) {
            double along = box->points[3 * (side + 1) + k] - box->points[k];
            if (along == 0) continue;
            axes += 1;
            centre[k] += 0.5 * along;
            half[k] = 0.5 * fabs(along) + box->radius;
        }
        if (axes != 1) return 0;
    }
    return 1;
}

#endif
