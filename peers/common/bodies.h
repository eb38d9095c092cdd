/*
 * A query as two rigid bodies that are cast: each by the translation of its first point. The points of a query are those
 * of tunnelproof_subject.h: x y z of A B C D at the start of the step, then at its end.
 */
#ifndef PEERS_BODIES_H
#define PEERS_BODIES_H

#include <math.h>
#include <stdlib.h>

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

#endif
