/* The header, compiled as C99 and as C++, and the library, by cases whose answers are known exactly. */
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

static void one_by_one(void) {
  tunnelproof_edge_hit edge;
  tunnelproof_face_hit face;
  const double radii[2] = {0.25, 0.25};
  double points[24];

  CHECK(tunnelproof_edge_edge(falling, NULL, &edge) == TUNNELPROOF_HIT);
  CHECK(edge.toi == 0.25 && edge.toi_above == 0.25 && edge.crosses == 1);
  CHECK(edge.u == 0.75 && edge.v == 0.5 && edge.is_overlap == 0);
  CHECK(edge.second_u == edge.u && edge.second_v == edge.v);
  CHECK(edge.side == 1 && edge.parameter_error <= ldexp(1, -32));
  CHECK(tunnelproof_edge_edge(falling, NULL, NULL) == TUNNELPROOF_HIT);
  /* Half a metre above, at 1/8. */
  CHECK(tunnelproof_edge_edge(falling, radii, &edge) == TUNNELPROOF_HIT);
  CHECK(edge.toi == 0.125);

  CHECK(tunnelproof_vertex_face(through, NULL, &face) == TUNNELPROOF_HIT);
  CHECK(face.toi == 0.25 && face.crosses == 1 && face.side == 1);
  CHECK(face.weights[0] == 0.5 && face.weights[1] == 0.25 && face.weights[2] == 0.25);

  memcpy(points, falling, sizeof points);
  points[20] = points[23] = 0.5;
  CHECK(tunnelproof_edge_edge(points, NULL, &edge) == TUNNELPROOF_MISS);
}

static void refused(void) {
  double points[24];
  const double negative[2] = {0.5, -1};
  memcpy(points, falling, sizeof points);
  CHECK(tunnelproof_edge_edge(NULL, NULL, NULL) == TUNNELPROOF_NULL);
  CHECK(tunnelproof_edge_edge(points, negative, NULL) == TUNNELPROOF_RADIUS);
  points[7] = INFINITY;
  CHECK(tunnelproof_edge_edge(points, NULL, NULL) == TUNNELPROOF_NOT_FINITE);
  CHECK(tunnelproof_vertex_face(points, NULL, NULL) == TUNNELPROOF_NOT_FINITE);
}

enum { COUNT = 10000 };
static double many[24 * COUNT];
static double radii[2 * COUNT];
static int32_t verdicts[COUNT];
static tunnelproof_edge_hit edges[COUNT];
static tunnelproof_face_hit faces[COUNT];

/* A number in [-1, 1) of a generator that is the same everywhere. */
static double drawn(void) {
  static uint64_t state = 1;
  state = state * 6364136223846793005u + 1442695040888963407u;
  return (double)(int32_t)(state >> 32) / 2147483648.0;
}

/* What a batch says is what is said one by one, bit for bit. */
static void in_batch(const double *with_radii) {
  int64_t edge_hits = 0, face_hits = 0;
  size_t i;
  CHECK(tunnelproof_edge_edge_batch(many, with_radii, COUNT, verdicts, edges) > COUNT / 10);
  for (i = 0; i < COUNT; i++) {
    tunnelproof_edge_hit hit;
    const double *radius = with_radii ? with_radii + 2 * i : NULL;
    CHECK(tunnelproof_edge_edge(many + 24 * i, radius, &hit) == verdicts[i]);
    if (verdicts[i] == TUNNELPROOF_HIT) {
      edge_hits += 1;
      CHECK(memcmp(&hit.toi, &edges[i].toi, 7 * sizeof hit.toi) == 0);
      CHECK(hit.crosses == edges[i].crosses && hit.side == edges[i].side);
    }
  }
  CHECK(tunnelproof_edge_edge_batch(many, with_radii, COUNT, verdicts, NULL) == edge_hits);
  CHECK(tunnelproof_vertex_face_batch(many, with_radii, COUNT, verdicts, faces) > COUNT / 50);
  for (i = 0; i < COUNT; i++) {
    tunnelproof_face_hit hit;
    const double *radius = with_radii ? with_radii + 2 * i : NULL;
    CHECK(tunnelproof_vertex_face(many + 24 * i, radius, &hit) == verdicts[i]);
    if (verdicts[i] == TUNNELPROOF_HIT) {
      face_hits += 1;
      CHECK(memcmp(&hit.toi, &faces[i].toi, 6 * sizeof hit.toi) == 0);
    }
  }
  CHECK(tunnelproof_vertex_face_batch(many, with_radii, COUNT, verdicts, NULL) == face_hits);
}

int main(void) {
  size_t i;
  one_by_one();
  refused();
  for (i = 0; i < 24 * COUNT; i++) many[i] = drawn();
  for (i = 0; i < 2 * COUNT; i++) radii[i] = fabs(drawn()) / 16;
  in_batch(NULL);
  in_batch(radii);
  /* One that is refused keeps its place. */
  many[24 * 5000 + 3] = NAN;
  CHECK(tunnelproof_edge_edge_batch(many, NULL, COUNT, verdicts, edges) > COUNT / 10);
  CHECK(verdicts[5000] == TUNNELPROOF_NOT_FINITE && verdicts[5001] >= TUNNELPROOF_MISS);
  CHECK(tunnelproof_edge_edge_batch(NULL, NULL, 1, verdicts, NULL) == TUNNELPROOF_NULL);
  CHECK(tunnelproof_edge_edge_batch(NULL, NULL, 0, NULL, NULL) == 0);
  CHECK(strcmp(tunnelproof_version(), "0.1.0") == 0);
  printf("%d failures\n", failures);
  return failures != 0;
}
