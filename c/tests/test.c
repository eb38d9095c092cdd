/* The header, compiled as C99 and as C++, and the library, by cases with known answers. */
#include "tunnelproof.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static int failures = 0;

#define CHECK(condition)                                                      \
  do {                                                                        \
    if (!(condition)) {                                                       \
      printf("%s:%d: %s\n", __FILE__, __LINE__, #condition);                  \
      failures += 1;                                                          \
    }                                                                         \
  } while (0)

/* AB rests along x; CD, along y at x = 0.5, falls from z = 1 to -3. They meet at 1/4. */
static const double falling[24] = {
    -1, 0, 0, 1, 0, 0, 0.5, -1, 1,  0.5, 1, 1,
    -1, 0, 0, 1, 0, 0, 0.5, -1, -3, 0.5, 1, -3,
};

/* A falls through the face BCD at 1/4. */
static const double through[24] = {
    0, 0, 1,  -1, -1, 0, 3, -1, 0, -1, 3, 0,
    0, 0, -3, -1, -1, 0, 3, -1, 0, -1, 3, 0,
};

static double length(const double *vector) {
  return hypot(hypot(vector[0], vector[1]), vector[2]);
}

/* Whether a vector is within an error of another. */
static int is_near(const double *vector, double x, double y, double z, double error) {
  const double difference[3] = {vector[0] - x, vector[1] - y, vector[2] - z};
  return length(difference) <= error;
}

static void one_by_one(void) {
  tunnelproof_hit hit;
  const double radii[2] = {0.25, 0.25};
  const double *weights = hit.first.weights;
  double points[24];

  CHECK(tunnelproof_decide_edge_edge(falling, NULL, &hit) == TUNNELPROOF_HIT);
  CHECK(hit.toi == 0.25 && hit.toi_above == 0.25);
  CHECK(hit.kind == TUNNELPROOF_CROSSING && hit.side == 1);
  CHECK(hit.motion_case == TUNNELPROOF_GENERAL);
  CHECK(hit.temporarily_parallel == 0 && hit.temporarily_point == 0);
  CHECK(weights[0] == 0.25 && weights[1] == 0.75 && weights[2] == 0.5 && weights[3] == 0.5);
  CHECK(is_near(hit.first.point, 0.5, 0, 0, 0) && hit.place_error <= ldexp(1, -32));
  CHECK(hit.has_second == 0 && memcmp(&hit.second, &hit.first, sizeof hit.first) == 0);
  /* From AB to CD, which is above it. */
  CHECK(is_near(hit.normal, 0, 0, 1, hit.normal_error) && hit.normal_error <= ldexp(1, -32));
  CHECK(tunnelproof_decide_edge_edge(falling, NULL, NULL) == TUNNELPROOF_HIT);
  /* Half a metre above, at 1/8. */
  CHECK(tunnelproof_decide_edge_edge(falling, radii, &hit) == TUNNELPROOF_HIT);
  CHECK(hit.toi == 0.125 && is_near(hit.normal, 0, 0, 1, hit.normal_error));
  CHECK(is_near(hit.first.point, 0.5, 0, 0, 1e-9));

  CHECK(tunnelproof_decide_vertex_face(through, NULL, &hit) == TUNNELPROOF_HIT);
  CHECK(hit.toi == 0.25 && hit.kind == TUNNELPROOF_CROSSING && hit.side == 1);
  CHECK(weights[0] == 1 && weights[1] == 0.5 && weights[2] == 0.25 && weights[3] == 0.25);
  CHECK(is_near(hit.first.point, 0, 0, 0, 0));
  /* From the vertex to the face, which is below it. */
  CHECK(is_near(hit.normal, 0, 0, -1, hit.normal_error) && hit.normal_error <= ldexp(1, -32));

  memcpy(points, falling, sizeof points);
  points[20] = points[23] = 0.5;
  CHECK(tunnelproof_decide_edge_edge(points, NULL, &hit) == TUNNELPROOF_MISS);
}

/* CD falls onto AB, along which it lies: they overlap from x = 0 to 1. */
static void overlap(void) {
  static const double points[24] = {
      -1, 0, 0, 1, 0, 0, 0, 0, 1,  2, 0, 1,
      -1, 0, 0, 1, 0, 0, 0, 0, -1, 2, 0, -1,
  };
  tunnelproof_hit hit;
  CHECK(tunnelproof_decide_edge_edge(points, NULL, &hit) == TUNNELPROOF_HIT);
  CHECK(hit.toi == 0.5 && hit.motion_case == TUNNELPROOF_PARALLEL && hit.has_second == 1);
  CHECK(is_near(hit.first.point, 0, 0, 0, 0) && is_near(hit.second.point, 1, 0, 0, 0));
  CHECK(hit.first.weights[1] == 0.5 && hit.first.weights[3] == 0);
  CHECK(hit.second.weights[1] == 1 && hit.second.weights[3] == 0.5);
  CHECK(is_near(hit.normal, 0, 0, 1, hit.normal_error));
}

/* They touch at the start: no normal. */
static void at_start(void) {
  double points[24];
  tunnelproof_hit hit;
  memcpy(points, falling, sizeof points);
  points[8] = points[11] = 0;
  CHECK(tunnelproof_decide_edge_edge(points, NULL, &hit) == TUNNELPROOF_HIT);
  CHECK(hit.toi == 0 && hit.kind == TUNNELPROOF_GRAZE && hit.side == 0);
  CHECK(is_near(hit.normal, 0, 0, 0, 0) && hit.normal_error == 0);
}

static void refused(void) {
  double points[24];
  const double negative[2] = {0.5, -1};
  memcpy(points, falling, sizeof points);
  CHECK(tunnelproof_decide_edge_edge(NULL, NULL, NULL) == TUNNELPROOF_NULL);
  CHECK(tunnelproof_decide_edge_edge(points, negative, NULL) == TUNNELPROOF_RADIUS);
  points[7] = INFINITY;
  CHECK(tunnelproof_decide_edge_edge(points, NULL, NULL) == TUNNELPROOF_NOT_FINITE);
  CHECK(tunnelproof_decide_vertex_face(points, NULL, NULL) == TUNNELPROOF_NOT_FINITE);
}

enum { COUNT = 10000 };
static double many[24 * COUNT];
static double radii[2 * COUNT];
static int32_t verdicts[COUNT];
static tunnelproof_hit hits[COUNT];

/* A number in [-1, 1) of a generator that is the same everywhere. */
static double drawn(void) {
  static uint64_t state = 1;
  state = state * 6364136223846793005u + 1442695040888963407u;
  return (double)(int32_t)(state >> 32) / 2147483648.0;
}

typedef int32_t decide(const double *, const double *, tunnelproof_hit *);
typedef int64_t decide_batch(const double *, const double *, size_t, int32_t *, tunnelproof_hit *);

/* What a batch says is what is said one by one, bit for bit. The struct has no padding. */
static void in_batch(decide *one, decide_batch *all, const double *with_radii, int64_t least) {
  int64_t count = 0;
  size_t i;
  CHECK(all(many, with_radii, COUNT, verdicts, hits) > least);
  for (i = 0; i < COUNT; i++) {
    tunnelproof_hit hit;
    const double *radius = with_radii ? with_radii + 2 * i : NULL;
    CHECK(one(many + 24 * i, radius, &hit) == verdicts[i]);
    if (verdicts[i] == TUNNELPROOF_HIT) {
      count += 1;
      CHECK(memcmp(&hit, &hits[i], sizeof hit) == 0);
      CHECK(hit.toi == 0 || fabs(length(hit.normal) - 1) < 1e-9);
    }
  }
  CHECK(all(many, with_radii, COUNT, verdicts, NULL) == count);
}

int main(void) {
  size_t i;
  one_by_one();
  overlap();
  at_start();
  refused();
  for (i = 0; i < 24 * COUNT; i++) many[i] = drawn();
  for (i = 0; i < 2 * COUNT; i++) radii[i] = fabs(drawn()) / 16;
  for (i = 0; i < 2; i++) {
    const double *with_radii = i ? radii : NULL;
    in_batch(tunnelproof_decide_edge_edge, tunnelproof_decide_edge_edge_batch, with_radii,
             COUNT / 10);
    in_batch(tunnelproof_decide_vertex_face, tunnelproof_decide_vertex_face_batch, with_radii,
             COUNT / 50);
  }
  /* One that is refused keeps its place. */
  many[24 * 5000 + 3] = NAN;
  CHECK(tunnelproof_decide_edge_edge_batch(many, NULL, COUNT, verdicts, hits) > COUNT / 10);
  CHECK(verdicts[5000] == TUNNELPROOF_NOT_FINITE && verdicts[5001] >= TUNNELPROOF_MISS);
  CHECK(tunnelproof_decide_edge_edge_batch(NULL, NULL, 1, verdicts, NULL) == TUNNELPROOF_NULL);
  CHECK(tunnelproof_decide_edge_edge_batch(NULL, NULL, 0, NULL, NULL) == 0);
  CHECK(strcmp(tunnelproof_version(), "0.1.0") == 0);
  printf("%d failures\n", failures);
  return failures != 0;
}
