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

/* Pairs whose positions are float numbers, as such: the same hits, bit for bit. */
static void pairs_by_index_f32(const tunnelproof_pairs *pairs) {
  float start[18], end[18];
  tunnelproof_pairs_f32 same = {start, end, pairs->point_count, pairs->indices, pairs->pair_count,
                                pairs->radii, pairs->radius_count};
  tunnelproof_pair_hit hits[3], expected[3];
  tunnelproof_error error;
  int64_t count;
  size_t i;

  for (i = 0; i < 3 * pairs->point_count; i++) {
    start[i] = (float)pairs->start[i];
    end[i] = (float)pairs->end[i];
  }
  memset(hits, 0, sizeof hits);
  memset(expected, 0, sizeof expected);
  count = tunnelproof_decide_edge_edge_pairs(pairs, expected, 3, NULL);
  CHECK(count > 0 && tunnelproof_decide_edge_edge_pairs_f32(&same, hits, 3, NULL) == count);
  CHECK(memcmp(hits, expected, sizeof hits) == 0);
  count = tunnelproof_decide_vertex_face_pairs(pairs, expected, 3, NULL);
  CHECK(tunnelproof_decide_vertex_face_pairs_f32(&same, hits, 3, NULL) == count);
  end[4] = NAN;
  CHECK(tunnelproof_decide_vertex_face_pairs_f32(&same, hits, 3, &error) == TUNNELPROOF_NOT_FINITE);
  CHECK(strcmp(error.array, "end") == 0 && error.index == 1 && error.corner == 1);
}

/* Pairs by index: one falls through AB, of another AB is at rest beside it. */
static void pairs_by_index(void) {
  double start[18], end[18];
  const uint32_t indices[12] = {0, 1, 2, 3, 4, 5, 2, 3, 2, 3, 1, 0};
  const double radii[6] = {0, 0, 0.25, 0.25, 0, 0};
  tunnelproof_pair_hit hits[3];
  tunnelproof_hit hit;
  tunnelproof_error error;
  tunnelproof_pairs pairs = {start, end, 6, indices, 3, NULL, 0};
  int i;

  memcpy(start, falling, sizeof(double) * 12);
  memcpy(end, falling + 12, sizeof(double) * 12);
  for (i = 0; i < 6; i++) {
    start[12 + i] = end[12 + i] = falling[i];
  }
  /* Half a metre before the end of CD. */
  start[13] = end[13] = start[16] = end[16] = 1.5;
  memset(hits, -1, sizeof hits);
  CHECK(tunnelproof_decide_edge_edge_pairs(&pairs, hits, 3, &error) == 2);
  CHECK(hits[0].pair == 0 && hits[1].pair == 2 && hits[2].pair == (size_t)-1);
  CHECK(tunnelproof_decide_edge_edge(falling, NULL, &hit) == TUNNELPROOF_HIT);
  CHECK(memcmp(&hits[0].hit, &hit, sizeof hit) == 0);
  CHECK(hits[1].hit.toi == 0.25 && hits[1].hit.side == -1);
  /* Room for one. */
  memset(hits, -1, sizeof hits);
  CHECK(tunnelproof_decide_edge_edge_pairs(&pairs, hits, 1, &error) == 2);
  CHECK(hits[0].pair == 0 && hits[1].pair == (size_t)-1);
  CHECK(tunnelproof_decide_edge_edge_pairs(&pairs, NULL, 0, NULL) == 2);
  /* A radius for each, and one for all. */
  pairs.radii = radii;
  pairs.radius_count = 3;
  CHECK(tunnelproof_decide_edge_edge_pairs(&pairs, hits, 3, &error) == 3);
  CHECK(hits[1].pair == 1 && hits[1].hit.toi == 0.25);
  pairs.radii = radii + 2;
  pairs.radius_count = 1;
  CHECK(tunnelproof_decide_edge_edge_pairs(&pairs, hits, 3, &error) == 3);
  CHECK(hits[0].hit.toi == 0.125);
  CHECK(tunnelproof_decide_vertex_face_pairs(&pairs, NULL, 0, &error) >= 0);
  pairs_by_index_f32(&pairs);
  /* What is refused. */
  pairs.radius_count = 2;
  CHECK(tunnelproof_decide_edge_edge_pairs(&pairs, hits, 3, &error) == TUNNELPROOF_LENGTH);
  CHECK(error.code == TUNNELPROOF_LENGTH && strcmp(error.array, "radii") == 0);
  CHECK(error.index == 3 && error.value == 2);
  pairs.radius_count = 0;
  pairs.point_count = 5;
  CHECK(tunnelproof_decide_edge_edge_pairs(&pairs, hits, 3, &error) == TUNNELPROOF_INDEX);
  CHECK(strcmp(error.array, "indices") == 0 && error.index == 1 && error.corner == 1);
  CHECK(error.value == 5);
  pairs.point_count = 6;
  end[16] = NAN;
  CHECK(tunnelproof_decide_edge_edge_pairs(&pairs, hits, 3, NULL) == TUNNELPROOF_NOT_FINITE);
  CHECK(tunnelproof_decide_edge_edge_pairs(&pairs, hits, 3, &error) == TUNNELPROOF_NOT_FINITE);
  CHECK(strcmp(error.array, "end") == 0 && error.index == 5 && error.corner == 1);
  CHECK(error.value != error.value);
  end[16] = 1.5;
  start[0] = -1;
  pairs.radius_count = 3;
  pairs.radii = start;
  CHECK(tunnelproof_decide_edge_edge_pairs(&pairs, hits, 3, &error) == TUNNELPROOF_RADIUS);
  CHECK(strcmp(error.array, "radii") == 0 && error.index == 0 && error.value == -1);
  pairs.radii = NULL;
  CHECK(tunnelproof_decide_edge_edge_pairs(&pairs, hits, 3, &error) == TUNNELPROOF_NULL);
  CHECK(strcmp(error.array, "radii") == 0);
  CHECK(tunnelproof_decide_edge_edge_pairs(NULL, hits, 3, &error) == TUNNELPROOF_NULL);
  CHECK(strcmp(error.array, "pairs") == 0);
  pairs.pair_count = pairs.radius_count = 0;
  pairs.indices = NULL;
  CHECK(tunnelproof_decide_edge_edge_pairs(&pairs, NULL, 0, &error) == 0);
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

/* A wire at rest; a rod on the x axis of its body, which turns by 90 degrees about z. They meet at
 * 45, where t / (1 - t) is the tangent of 22.5 degrees, or t the square root of 2, less 1. */
static const double wire[12] = {1, 1, -1, 1, 1, 1, 1, 1, -1, 1, 1, 1};
static const double rod[6] = {0, 0, 0, 2, 0, 0};
static const double quarter[14] = {0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1};

static void turning(void) {
  const double half_root = sqrt(0.5);
  const double radii[2] = {0.1, 0.2};
  const double vertex[6] = {1, 1, 0, 1, 1, 0};
  const double face[9] = {0, 0, -1, 2, 0, -1, 1, 0, 2};
  const double *weights;
  tunnelproof_hit hit;

  memset(&hit, 0xff, sizeof hit);
  CHECK(tunnelproof_decide_edge_turning_edge(wire, rod, quarter, NULL, &hit) == TUNNELPROOF_HIT);
  CHECK(hit.toi <= 2 * half_root - 1 && nextafter(hit.toi, 1) == hit.toi_above);
  CHECK(fabs(hit.toi - (2 * half_root - 1)) < 1e-15);
  CHECK(hit.kind == TUNNELPROOF_CROSSING && hit.side == -1);
  CHECK(hit.motion_case == TUNNELPROOF_GENERAL && hit.has_second == 0);
  CHECK(hit.temporarily_parallel == 0 && hit.temporarily_point == 0);
  weights = hit.first.weights;
  CHECK(fabs(weights[0] - 0.5) < 1e-15 && fabs(weights[1] - 0.5) < 1e-15);
  CHECK(fabs(weights[2] - 1 + half_root) < 1e-15 && fabs(weights[3] - half_root) < 1e-15);
  CHECK(is_near(hit.first.point, 1, 1, 0, 1e-15) && hit.place_error <= ldexp(1, -50));
  CHECK(memcmp(&hit.second, &hit.first, sizeof hit.first) == 0);
  /* From the wire to the rod, which comes from the x axis. */
  CHECK(is_near(hit.normal, half_root, -half_root, 0, 1e-14));
  CHECK(hit.normal_error > 0 && hit.normal_error <= 1e-14);
  CHECK(tunnelproof_decide_edge_turning_edge(wire, rod, quarter, NULL, NULL) == TUNNELPROOF_HIT);

  CHECK(tunnelproof_decide_edge_turning_edge(wire, rod, quarter, radii, &hit) == TUNNELPROOF_HIT);
  CHECK(hit.toi < 0.35);
  CHECK(tunnelproof_decide_vertex_turning_face(vertex, face, quarter, NULL, &hit) ==
        TUNNELPROOF_HIT);
  CHECK(fabs(hit.toi - (2 * half_root - 1)) < 1e-15 && hit.first.weights[0] == 1);
  CHECK(is_near(hit.first.point, 1, 1, 0, 0) && hit.has_second == 0);
}

static void turning_refused(void) {
  static const double tests[6][3] = {
      /* place among the poses, value, verdict */
      {3, 0, TUNNELPROOF_NO_ORIENTATION},
      {10, -1, TUNNELPROOF_TURNS_TOO_FAR},
      {10, 0.99, TUNNELPROOF_TURNS_TOO_FAR},
      {10, NAN, TUNNELPROOF_NOT_FINITE},
      {1, INFINITY, TUNNELPROOF_NOT_FINITE},
      {10, 1.01, TUNNELPROOF_HIT},
  };
  const double negative[2] = {0.5, -1};
  double poses[14], bad[6];
  int32_t verdict;
  int i;
  for (i = 0; i < 6; i++) {
    memcpy(poses, quarter, sizeof poses);
    poses[(int)tests[i][0]] = tests[i][1];
    if (i == 1) poses[13] = 3;
    verdict = tunnelproof_decide_edge_turning_edge(wire, rod, poses, NULL, NULL);
    CHECK(verdict == (int32_t)tests[i][2]);
  }
  memcpy(bad, rod, sizeof bad);
  bad[4] = NAN;
  CHECK(tunnelproof_decide_edge_turning_edge(wire, bad, quarter, NULL, NULL) ==
        TUNNELPROOF_NOT_FINITE);
  CHECK(tunnelproof_decide_edge_turning_edge(wire, rod, quarter, negative, NULL) ==
        TUNNELPROOF_RADIUS);
  CHECK(tunnelproof_decide_edge_turning_edge(NULL, rod, quarter, NULL, NULL) == TUNNELPROOF_NULL);
  CHECK(tunnelproof_decide_edge_turning_edge(wire, NULL, quarter, NULL, NULL) == TUNNELPROOF_NULL);
  CHECK(tunnelproof_decide_edge_turning_edge(wire, rod, NULL, NULL, NULL) == TUNNELPROOF_NULL);
  CHECK(tunnelproof_decide_edge_turning_edge_batch(wire, rod, quarter, NULL, 1, NULL, NULL) ==
        TUNNELPROOF_NULL);
  CHECK(tunnelproof_decide_vertex_turning_face_batch(NULL, NULL, NULL, NULL, 0, NULL, NULL) == 0);
}

/* Three that turn: the second is refused, the third has a radius that the others do not. */
static void turning_in_batch(void) {
  double points[36], local[18], poses[42], radii[6] = {0, 0, 0, 0, 0.1, 0.2};
  int32_t verdicts[3];
  tunnelproof_hit hits[3], one;
  int i;
  for (i = 0; i < 3; i++) {
    memcpy(points + 12 * i, wire, sizeof wire);
    memcpy(local + 6 * i, rod, sizeof rod);
    memcpy(poses + 14 * i, quarter, sizeof quarter);
  }
  for (i = 3; i < 7; i++) poses[14 + i] = 0;
  CHECK(tunnelproof_decide_edge_turning_edge_batch(points, local, poses, radii, 3, verdicts,
                                                   hits) == 2);
  CHECK(verdicts[0] == TUNNELPROOF_HIT && verdicts[1] == TUNNELPROOF_NO_ORIENTATION);
  CHECK(verdicts[2] == TUNNELPROOF_HIT && hits[2].toi < hits[0].toi);
  for (i = 0; i < 3; i += 2) {
    CHECK(tunnelproof_decide_edge_turning_edge(wire, rod, quarter, radii + 2 * i, &one) ==
          TUNNELPROOF_HIT);
    CHECK(memcmp(&one, &hits[i], sizeof one) == 0);
  }
  CHECK(tunnelproof_decide_edge_turning_edge_batch(points, local, poses, NULL, 3, verdicts,
                                                   NULL) == 2);
}

/* The same rod; the wire is of a body at rest, and then of one that turns with the rod. */
static void two_bodies(void) {
  double local[12], poses[28], many_local[24], many_poses[56];
  int32_t verdicts[2];
  tunnelproof_hit hit, other, hits[2];
  memcpy(local, wire, 6 * sizeof *local);
  memcpy(local + 6, rod, sizeof rod);
  memcpy(poses, quarter, 7 * sizeof *poses);
  memcpy(poses + 7, quarter, 7 * sizeof *poses);
  memcpy(poses + 14, quarter, sizeof quarter);
  CHECK(tunnelproof_decide_turning_edge_turning_edge(local, poses, NULL, &hit) == TUNNELPROOF_HIT);
  CHECK(tunnelproof_decide_edge_turning_edge(wire, rod, quarter, NULL, &other) == TUNNELPROOF_HIT);
  CHECK(hit.toi == other.toi && hit.toi_above == other.toi_above && hit.side == other.side);
  CHECK(is_near(hit.first.point, 1, 1, 0, 1e-15));
  CHECK(is_near(hit.normal, sqrt(0.5), -sqrt(0.5), 0, 1e-14) && hit.normal_error > 0);
  memcpy(many_local, local, sizeof local);
  memcpy(many_local + 12, local, sizeof local);
  memcpy(many_poses, poses, sizeof poses);
  memcpy(many_poses + 28, quarter, sizeof quarter);
  memcpy(many_poses + 42, quarter, sizeof quarter);
  CHECK(tunnelproof_decide_turning_edge_turning_edge_batch(many_local, many_poses, NULL, 2,
                                                           verdicts, hits) == 1);
  CHECK(verdicts[0] == TUNNELPROOF_HIT && verdicts[1] == TUNNELPROOF_MISS);
  CHECK(hits[0].toi == hit.toi);
  poses[17] = 0;
  CHECK(tunnelproof_decide_turning_edge_turning_edge(local, poses, NULL, NULL) ==
        TUNNELPROOF_NO_ORIENTATION);
  CHECK(tunnelproof_decide_turning_edge_turning_edge(NULL, poses, NULL, NULL) == TUNNELPROOF_NULL);
  CHECK(tunnelproof_decide_turning_vertex_turning_face(local, NULL, NULL, NULL) ==
        TUNNELPROOF_NULL);
  CHECK(tunnelproof_decide_turning_vertex_turning_face_batch(NULL, NULL, NULL, 0, NULL, NULL) == 0);
}

/* A vertex of a body that falls by 2 onto a face that rises by 2: they meet at the half. */
static void turning_vertex(void) {
  static const double local[12] = {0.25, 0.25, 1, 0, 0, -1, 1, 0, -1, 0, 1, -1};
  static const double poses[28] = {0, 0, 0, 1, 0, 0, 0, 0, 0, -2, 1, 0, 0, 0,
                                   0, 0, 0, 2, 0, 0, 0, 0, 0, 2,  2, 0, 0, 0};
  tunnelproof_hit hit;
  CHECK(tunnelproof_decide_turning_vertex_turning_face(local, poses, NULL, &hit) ==
        TUNNELPROOF_HIT);
  CHECK(hit.toi == 0.5 && hit.toi_above == 0.5);
  CHECK(is_near(hit.first.point, 0.25, 0.25, 0, 0));
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

/* CD stops above AB, and the points that are stored are apart. */
static void advanced(void) {
  const double radii[2] = {0.25, 0.25};
  tunnelproof_advance moved;
  double points[24];
  int i;
  memcpy(points, falling, sizeof points);

  CHECK(tunnelproof_advance_edge_edge(falling, NULL, 0, 0, &moved) == TUNNELPROOF_AHEAD);
  CHECK(moved.step <= 0.25 && moved.step > 0.25 - 1e-12 && moved.is_proved == 1);
  CHECK(moved.blocked == TUNNELPROOF_AHEAD && moved.kept[0] == 0 && moved.kept[1] == 0);
  memcpy(points + 12, moved.points, sizeof moved.points);
  CHECK(tunnelproof_decide_edge_edge(points, NULL, NULL) == TUNNELPROOF_MISS);

  CHECK(tunnelproof_advance_edge_edge(falling, radii, 0, 0.5, &moved) == TUNNELPROOF_AHEAD);
  CHECK(fabs(moved.kept[0] + moved.kept[1] - 0.75) < 1e-12);
  CHECK(fabs(moved.points[8] - 0.75) < 1e-12);
  CHECK(tunnelproof_advance_vertex_face(through, NULL, 0.5, 0, &moved) == TUNNELPROOF_AHEAD);
  CHECK(fabs(moved.points[2] - 0.5) < 1e-12);

  /* A whole step is the end, bit for bit; a touch at the start is no step. */
  points[20] = points[23] = 0.1;
  CHECK(tunnelproof_advance_edge_edge(points, NULL, 0, 0, &moved) == 0);
  CHECK(moved.step == 1 && memcmp(moved.points, points + 12, sizeof moved.points) == 0);
  points[8] = points[11] = 0;
  CHECK(tunnelproof_advance_edge_edge(points, NULL, 0, 0, &moved) == TUNNELPROOF_TOUCHING);
  CHECK(moved.step == 0 && moved.is_proved == 0);

  /* Stored as float, and no less apart. */
  CHECK(tunnelproof_advance_edge_edge_f32(falling, radii, 0, 0.3, &moved) == TUNNELPROOF_AHEAD);
  for (i = 0; i < 12; i++) CHECK((double)(float)moved.points[i] == moved.points[i]);
  memcpy(points, falling, sizeof points);
  memcpy(points + 12, moved.points, sizeof moved.points);
  CHECK(tunnelproof_decide_edge_edge(points, moved.kept, NULL) == TUNNELPROOF_MISS);
  CHECK(tunnelproof_advance_vertex_face_f32(through, NULL, 0.1, 0, &moved) == TUNNELPROOF_AHEAD);
  CHECK(moved.points[2] > 0.1 && (double)(float)moved.points[2] == moved.points[2]);

  CHECK(tunnelproof_advance_edge_edge_f32(falling, NULL, 0, 0, NULL) == TUNNELPROOF_NULL);
  CHECK(tunnelproof_advance_edge_edge(falling, NULL, 0, 0, NULL) == TUNNELPROOF_NULL);
  CHECK(tunnelproof_advance_edge_edge(falling, NULL, 1, 0.5, &moved) == TUNNELPROOF_CLEARANCE);
  CHECK(tunnelproof_advance_vertex_face(through, NULL, 0, 1, &moved) == TUNNELPROOF_CLEARANCE);
  CHECK(tunnelproof_advance_vertex_face(through, NULL, NAN, 0, &moved) == TUNNELPROOF_CLEARANCE);
}

/* A face at rest; an edge and a point fall through it. */
static const uint32_t edges[2] = {3, 4};
static const uint32_t faces[3] = {0, 1, 2};
static const double at_first[18] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 1, 1, 5, 1, 1, 1, 3};
static const double at_last[18] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, -3, 1, 5, -3, 1, 1, -1};

static void contacts_of_a_mesh(const tunnelproof_mesh *mesh) {
  tunnelproof_motion motion = {at_first, at_last, NULL, 0};
  tunnelproof_mesh_contact all[4];
  const double thickness = 0.5;

  memset(all, 0, sizeof all);
  CHECK(tunnelproof_mesh_is_free(mesh, &motion, NULL) == 0);
  CHECK(tunnelproof_mesh_first_contact(mesh, &motion, all, NULL) == TUNNELPROOF_HIT);
  CHECK(all[0].toi == 0.25 && all[0].kind == TUNNELPROOF_CROSSING);
  CHECK(all[0].pair.first_feature == TUNNELPROOF_EDGE && all[0].pair.first == 0);
  CHECK(all[0].pair.second_feature == TUNNELPROOF_EDGE && all[0].pair.second == 2);
  CHECK(all[0].pair.vertices[0] == 3 && all[0].pair.vertices[3] == 2);

  CHECK(tunnelproof_mesh_all_contacts(mesh, &motion, NULL, 0, NULL) == 3);
  CHECK(tunnelproof_mesh_all_contacts(mesh, &motion, all, 2, NULL) == 3 && all[2].toi == 0);
  CHECK(tunnelproof_mesh_all_contacts(mesh, &motion, all, 4, NULL) == 3);
  CHECK(all[2].pair.first_feature == TUNNELPROOF_VERTEX && all[2].pair.first == 5);
  CHECK(all[2].pair.second_feature == TUNNELPROOF_FACE && all[2].toi == 0.75);
  CHECK(all[2].first.weights[0] == 1 && is_near(all[2].first.point, 1, 1, 0, 0));
  CHECK(all[2].has_second == 0 && is_near(all[2].normal, 0, 0, -1, 1e-9));

  motion.thickness = &thickness;
  motion.thickness_count = 1;
  CHECK(tunnelproof_mesh_first_contact(mesh, &motion, all, NULL) == TUNNELPROOF_HIT);
  CHECK(all[0].toi == 0.125);
  motion.end = at_first;
  CHECK(tunnelproof_mesh_is_free(mesh, &motion, NULL) == 1);
  CHECK(tunnelproof_mesh_first_contact(mesh, &motion, NULL, NULL) == TUNNELPROOF_MISS);
}

static void steps_of_a_mesh(const tunnelproof_mesh *mesh) {
  double x[18], wanted[18];
  const double thickness = 0.01;
  tunnelproof_motion motion = {x, wanted, &thickness, 1};
  tunnelproof_limit limits[2];
  tunnelproof_near_pair near_pairs[1];
  tunnelproof_step step = {x, limits, 2, near_pairs, 1, 0, 0, 0, {0, 0}};
  int i, k;

  memcpy(x, at_first, sizeof x);
  for (i = 0; i < 10; i++) {
    double before[18];
    const tunnelproof_motion moved = {before, x, &thickness, 1};
    memcpy(before, x, sizeof x);
    memcpy(wanted, x, sizeof x);
    for (k = 3; k < 6; k++) wanted[3 * k + 2] -= 0.3;
    /* The positions go to where the start was. */
    CHECK(tunnelproof_mesh_step(mesh, &motion, 0, 0, &step, NULL) == 0);
    CHECK(tunnelproof_mesh_is_free(mesh, &moved, NULL) == 1);
    CHECK((step.step == 1) == (step.limit_count == 0) && (i > 2) == (step.limit_count > 0));
  }
  CHECK(x[11] > 0.01 && x[11] < 0.01 + 1e-9 && x[17] > 1.9);
  CHECK(step.limit_count == 2 && limits[0].pair.vertices[0] == 3);
  CHECK(limits[0].blocked == TUNNELPROOF_AHEAD || limits[0].blocked == TUNNELPROOF_ROUNDING);
  CHECK(step.candidates[0] > 0 && step.candidates[1] > 0);

  memcpy(x, at_first, sizeof x);
  memcpy(wanted, at_last, sizeof x);
  CHECK(tunnelproof_mesh_step(mesh, &motion, 2, 0, &step, NULL) == 0);
  CHECK(step.near_count > 1 && near_pairs[0].pair.vertices[0] == 3);
  CHECK(near_pairs[0].kept[0] + near_pairs[0].kept[1] > 0.89);
}

/* Positions that are float: contacts of the same numbers in double, and steps in place of the end. */
static void of_a_mesh_in_f32(const tunnelproof_mesh *mesh) {
  const double thickness = 0.25;
  float first[18], last[18];
  tunnelproof_motion motion = {at_first, at_last, &thickness, 1};
  tunnelproof_motion_f32 same = {first, last, &thickness, 1};
  tunnelproof_step_f32 step = {last, NULL, 0, NULL, 0, 0, 0, 0, {0, 0}};
  tunnelproof_mesh_contact all[8], expected[8];
  tunnelproof_error error;
  int64_t count;
  int i;

  for (i = 0; i < 18; i++) {
    first[i] = (float)at_first[i];
    last[i] = (float)at_last[i];
  }
  memset(all, 0, sizeof all);
  memset(expected, 0, sizeof expected);
  CHECK(tunnelproof_mesh_first_contact(mesh, &motion, expected, NULL) == TUNNELPROOF_HIT);
  CHECK(tunnelproof_mesh_first_contact_f32(mesh, &same, all, NULL) == TUNNELPROOF_HIT);
  CHECK(memcmp(all, expected, sizeof all) == 0);
  count = tunnelproof_mesh_all_contacts(mesh, &motion, expected, 8, NULL);
  CHECK(count > 2 && tunnelproof_mesh_all_contacts_f32(mesh, &same, all, 8, NULL) == count);
  CHECK(memcmp(all, expected, sizeof all) == 0);
  CHECK(tunnelproof_mesh_is_free_f32(mesh, &same, NULL) == 0);
  /* The positions go to where the end was: motion to them is free, and they are next to the face. */
  CHECK(tunnelproof_mesh_step_f32(mesh, &same, 0, 0, &step, NULL) == 0);
  CHECK(step.step > 0 && step.step < 0.1875 && step.limit_count > 0);
  CHECK(last[11] > 0.25f && last[11] < 0.250001f);
  CHECK(tunnelproof_mesh_is_free_f32(mesh, &same, NULL) == 1);
  last[7] = NAN;
  CHECK(tunnelproof_mesh_step_f32(mesh, &same, 0, 0, &step, &error) == TUNNELPROOF_NOT_FINITE);
  CHECK(strcmp(error.array, "end") == 0 && error.index == 2 && error.corner == 1);
  CHECK(tunnelproof_mesh_first_contact_f32(mesh, NULL, all, &error) == TUNNELPROOF_NULL);
}

static void refused_of_a_mesh(tunnelproof_mesh *mesh) {
  tunnelproof_motion motion = {at_first, at_last, NULL, 0};
  tunnelproof_error error;
  tunnelproof_step step = {NULL, NULL, 0, NULL, 0, 0, 0, 0, {0, 0}};
  const double thicknesses[2] = {1, -1};
  const uint32_t groups[6] = {0, 0, 0, 1, 1, 2};
  const uint32_t beyond[6] = {0, 1, 2, 2, 1, 6};
  double bad[18];

  CHECK(tunnelproof_mesh_new(6, edges, 1, beyond, 2, &error) == NULL);
  CHECK(error.code == TUNNELPROOF_INDEX && strcmp(error.array, "faces") == 0);
  CHECK(error.index == 1 && error.corner == 2 && error.value == 6);
  CHECK(tunnelproof_mesh_new(6, NULL, 1, NULL, 0, &error) == NULL);
  CHECK(error.code == TUNNELPROOF_NULL && strcmp(error.array, "edges") == 0);
  CHECK(tunnelproof_mesh_new(6, beyond, 3, NULL, 0, NULL) == NULL);
  tunnelproof_mesh_free(NULL);

  CHECK(tunnelproof_mesh_is_free(NULL, &motion, &error) == TUNNELPROOF_NULL);
  CHECK(strcmp(error.array, "mesh") == 0);
  CHECK(tunnelproof_mesh_all_contacts(mesh, NULL, NULL, 0, NULL) == TUNNELPROOF_NULL);
  CHECK(tunnelproof_mesh_step(mesh, &motion, 0, 0, NULL, NULL) == TUNNELPROOF_NULL);
  CHECK(tunnelproof_mesh_step(mesh, &motion, 0, 0, &step, &error) == TUNNELPROOF_NULL);
  CHECK(strcmp(error.array, "positions") == 0);
  step.positions = bad;
  CHECK(tunnelproof_mesh_step(mesh, &motion, -1, 0, &step, &error) == TUNNELPROOF_CLEARANCE);
  CHECK(strcmp(error.array, "clearance") == 0);
  CHECK(tunnelproof_mesh_step(mesh, &motion, 1, 0.5, &step, NULL) == TUNNELPROOF_CLEARANCE);

  memcpy(bad, at_last, sizeof bad);
  bad[7] = NAN;
  motion.end = bad;
  CHECK(tunnelproof_mesh_is_free(mesh, &motion, &error) == TUNNELPROOF_NOT_FINITE);
  CHECK(strcmp(error.array, "end") == 0 && error.index == 2 && error.corner == 1);
  CHECK(error.value != error.value);
  motion.end = NULL;
  CHECK(tunnelproof_mesh_first_contact(mesh, &motion, NULL, &error) == TUNNELPROOF_NULL);
  CHECK(strcmp(error.array, "end") == 0);

  motion.end = at_last;
  motion.thickness = thicknesses + 1;
  motion.thickness_count = 1;
  CHECK(tunnelproof_mesh_is_free(mesh, &motion, &error) == TUNNELPROOF_RADIUS);
  CHECK(error.value == -1);
  CHECK(tunnelproof_mesh_set_groups(mesh, NULL, NULL) == TUNNELPROOF_NULL);
  CHECK(tunnelproof_mesh_set_groups(mesh, groups, NULL) == 0);
  motion.thickness = thicknesses;
  motion.thickness_count = 2;
  CHECK(tunnelproof_mesh_is_free(mesh, &motion, &error) == TUNNELPROOF_LENGTH);
  CHECK(error.index == 3 && error.value == 2);
  CHECK(tunnelproof_mesh_leave_out(mesh, 3, 0, &error) == TUNNELPROOF_INDEX && error.value == 3);
  CHECK(tunnelproof_mesh_leave_out(mesh, 0, 1, NULL) == 0);
  CHECK(tunnelproof_mesh_leave_out(mesh, 2, 0, NULL) == 0);
  motion.thickness_count = 0;
  CHECK(tunnelproof_mesh_is_free(mesh, &motion, NULL) == 1);
}

/* All pairs of that mesh, in its order: of edges and of the point, which is both ends of its edge, and
 * of a vertex and the face. */
enum { EDGE_PAIRS = 7, FACE_PAIRS = 3 };
static const uint32_t edge_pairs[4 * EDGE_PAIRS] = {
    3, 4, 0, 1, 3, 4, 1, 2, 3, 4, 2, 0, 3, 4, 5, 5, 0, 1, 5, 5, 1, 2, 5, 5, 2, 0, 5, 5,
};
static const uint32_t face_pairs[4 * FACE_PAIRS] = {3, 0, 1, 2, 4, 0, 1, 2, 5, 0, 1, 2};

/* The indices of a pair. */
static const uint32_t *listed(tunnelproof_listed_pair pair) {
  return (pair.kind == TUNNELPROOF_EDGE_EDGE ? edge_pairs : face_pairs) + 4 * pair.index;
}

/* The pairs that end a step and that are near, of the list and of the mesh. */
typedef struct named {
  tunnelproof_limit limits[10];
  tunnelproof_near_pair near_pairs[10];
  tunnelproof_pairs_limit listed_limits[10];
  tunnelproof_near_listed_pair near_listed[10];
} named;

static void same_pairs(const named *all, size_t limit_count, size_t near_count) {
  size_t k;
  for (k = 0; k < limit_count; k++) {
    const uint32_t *indices = listed(all->listed_limits[k].pair);
    CHECK(memcmp(indices, all->limits[k].pair.vertices, 4 * sizeof *indices) == 0);
    CHECK(all->listed_limits[k].blocked == all->limits[k].blocked);
  }
  for (k = 0; k < near_count; k++) {
    const uint32_t *indices = listed(all->near_listed[k].pair);
    const double *kept = all->near_pairs[k].kept;
    CHECK(memcmp(indices, all->near_pairs[k].pair.vertices, 4 * sizeof *indices) == 0);
    CHECK(memcmp(all->near_listed[k].kept, kept, 2 * sizeof *kept) == 0);
  }
}

/* The step of pairs is that of the mesh whose pairs they are, bit for bit; also of float. */
static void steps_as_of_a_mesh(const tunnelproof_mesh *mesh) {
  static const double settings[5][2] = {{0, 0}, {0.25, 0}, {2, 0}, {0, 0.3}, {0, 0.9}};
  const double thickness = 0.01;
  const double radius[2] = {0.01, 0};
  double of_mesh[18], of_pairs[18];
  float single_of_mesh[18], single_of_pairs[18], first[18], last[18];
  named all;
  const tunnelproof_motion motion = {at_first, at_last, &thickness, 1};
  const tunnelproof_motion_f32 single_motion = {first, last, &thickness, 1};
  tunnelproof_step step = {of_mesh, all.limits, 10, all.near_pairs, 10, 0, 0, 0, {0, 0}};
  tunnelproof_step_f32 single_step = {single_of_mesh, all.limits, 10, all.near_pairs, 10,
                                      0, 0, 0, {0, 0}};
  tunnelproof_pairs_step moved = {of_pairs, all.listed_limits, 10, all.near_listed, 10, 0, 0, 0};
  tunnelproof_pairs_step_f32 single_moved = {single_of_pairs, all.listed_limits, 10,
                                             all.near_listed, 10, 0, 0, 0};
  const tunnelproof_pairs edges = {at_first, at_last, 6, edge_pairs, EDGE_PAIRS, radius, 1};
  const tunnelproof_pairs faces = {at_first, at_last, 6, face_pairs, FACE_PAIRS, radius, 1};
  const tunnelproof_pairs_f32 single_edges = {first, last, 6, edge_pairs, EDGE_PAIRS, radius, 1};
  const tunnelproof_pairs_f32 single_faces = {first, last, 6, face_pairs, FACE_PAIRS, radius, 1};
  size_t limit_count = 0, near_count = 0;
  int i;

  for (i = 0; i < 18; i++) {
    first[i] = (float)at_first[i];
    last[i] = (float)at_last[i];
  }
  for (i = 0; i < 5; i++) {
    const double clearance = settings[i][0], share = settings[i][1];
    CHECK(tunnelproof_mesh_step(mesh, &motion, clearance, share, &step, NULL) == 0);
    CHECK(tunnelproof_advance_pairs(&edges, &faces, clearance, share, &moved, NULL) == 0);
    CHECK(moved.step == step.step && memcmp(of_pairs, of_mesh, sizeof of_mesh) == 0);
    CHECK(moved.limit_count == step.limit_count && moved.near_count == step.near_count);
    same_pairs(&all, step.limit_count, step.near_count);
    limit_count += step.limit_count;
    near_count += step.near_count;

    CHECK(tunnelproof_mesh_step_f32(mesh, &single_motion, clearance, share, &single_step, NULL) ==
          0);
    CHECK(tunnelproof_advance_pairs_f32(&single_edges, &single_faces, clearance, share,
                                        &single_moved, NULL) == 0);
    CHECK(single_moved.step == single_step.step);
    CHECK(memcmp(single_of_pairs, single_of_mesh, sizeof single_of_mesh) == 0);
    CHECK(single_moved.limit_count == single_step.limit_count);
    CHECK(single_moved.near_count == single_step.near_count);
    same_pairs(&all, single_step.limit_count, single_step.near_count);
    CHECK(single_step.candidates[0] > 0 && single_step.candidates[1] > 0);
    /* There is less room. */
    CHECK(single_step.step <= step.step && single_step.step > step.step - 1e-5);
  }
  CHECK(limit_count > 2 && near_count > 0);
}

/* The edge and the point fall on the face in small steps, whose positions replace the start. Each of
 * the pairs of edges has a radius of its own; one edge never meets another one. */
static void steps_of_pairs(void) {
  double x[18], wanted[18];
  const double radius[2] = {0.01, 0}, radii[4] = {0.25, 0.125, 0, 0};
  tunnelproof_pairs_limit limits[2];
  tunnelproof_near_listed_pair near_pairs[1];
  tunnelproof_pairs_step step = {x, limits, 2, near_pairs, 1, 0, 0, 0};
  tunnelproof_pairs edges = {x, wanted, 6, edge_pairs, 2, radii, 2};
  tunnelproof_pairs faces = {x, wanted, 6, face_pairs, FACE_PAIRS, radius, 1};
  int i, k;

  memcpy(x, at_first, sizeof x);
  for (i = 0; i < 4; i++) {
    memcpy(wanted, x, sizeof x);
    for (k = 3; k < 6; k++) wanted[3 * k + 2] -= 0.3;
    CHECK(tunnelproof_advance_pairs(&edges, &faces, 0, 0, &step, NULL) == 0);
    CHECK((step.step == 1) == (step.limit_count == 0) && (i > 2) == (step.limit_count > 0));
    CHECK(i > 2 || memcmp(x, wanted, sizeof x) == 0);
  }
  CHECK(step.limit_count == 1 && limits[0].pair.kind == TUNNELPROOF_VERTEX_FACE);
  CHECK(limits[0].pair.index == 0 && limits[0].blocked == TUNNELPROOF_AHEAD);
  CHECK(x[11] > 0.01 && x[11] < 0.01 + 1e-9);

  /* A list may be empty. The edge 3, 4 meets 1, 2 first. */
  faces.pair_count = faces.radius_count = 0;
  faces.indices = NULL;
  memcpy(x, at_first, sizeof x);
  memcpy(wanted, at_last, sizeof x);
  CHECK(tunnelproof_advance_pairs(&edges, &faces, 0, 0, &step, NULL) == 0);
  CHECK(step.limit_count == 1 && limits[0].pair.kind == TUNNELPROOF_EDGE_EDGE);
  CHECK(limits[0].pair.index == 1 && step.near_count == 0);

  /* Room for one, and for none. */
  faces.pair_count = FACE_PAIRS;
  faces.indices = face_pairs;
  memset(near_pairs, -1, sizeof near_pairs);
  memset(limits, -1, sizeof limits);
  memcpy(x, at_first, sizeof x);
  step.limit_capacity = step.near_capacity = 0;
  CHECK(tunnelproof_advance_pairs(&edges, &faces, 2, 0, &step, NULL) == 0);
  CHECK(step.limit_count > 0 && step.near_count > 1);
  CHECK(limits[0].blocked == -1 && near_pairs[0].pair.kind == -1);
  memcpy(x, at_first, sizeof x);
  step.near_capacity = 1;
  step.limits = NULL;
  step.limit_capacity = 2;
  CHECK(tunnelproof_advance_pairs(&edges, &faces, 2, 0, &step, NULL) == 0);
  CHECK(near_pairs[0].pair.kind == TUNNELPROOF_EDGE_EDGE && near_pairs[0].pair.index == 0);
  CHECK(near_pairs[0].kept[0] + near_pairs[0].kept[1] > 1.29);
  CHECK(limits[0].blocked == -1 && limits[1].blocked == -1);

  /* Two that touch at the start do not move. */
  memcpy(x, at_first, sizeof x);
  x[11] = x[14] = 0;
  step.limits = limits;
  CHECK(tunnelproof_advance_pairs(&edges, &faces, 0, 0, &step, NULL) == 0);
  CHECK(step.step == 0 && step.limit_count > 0 && x[17] == 3);
  CHECK(limits[0].blocked == TUNNELPROOF_TOUCHING);

  /* No points, and no pairs. */
  edges.point_count = edges.pair_count = edges.radius_count = 0;
  edges.start = edges.end = NULL;
  step.positions = NULL;
  CHECK(tunnelproof_advance_pairs(&edges, &edges, 0, 0, &step, NULL) == 0);
  CHECK(step.step == 1 && step.limit_count == 0 && step.near_count == 0);
}

/* What a step of pairs refuses, and of which list. */
static void refused_of_pairs(void) {
  double x[18], bad[18];
  const double negative[2] = {0, -1};
  const uint32_t beyond[4] = {0, 6, 1, 2};
  const tunnelproof_pairs edges = {at_first, at_last, 6, edge_pairs, EDGE_PAIRS, NULL, 0};
  tunnelproof_pairs faces = {at_first, at_last, 6, face_pairs, FACE_PAIRS, NULL, 0};
  tunnelproof_pairs_step step = {NULL, NULL, 0, NULL, 0, -1, 0, 0};
  tunnelproof_error error;

#define REFUSED(edges, faces, clearance, share, expected, name)                                 \
  do {                                                                                          \
    CHECK(tunnelproof_advance_pairs(edges, faces, clearance, share, &step, NULL) == (expected)); \
    CHECK(tunnelproof_advance_pairs(edges, faces, clearance, share, &step, &error) == (expected)); \
    CHECK(error.code == (expected) && strcmp(error.array, name) == 0);                          \
  } while (0)

  REFUSED(&edges, &faces, 0, 0, TUNNELPROOF_NULL, "positions");
  CHECK(tunnelproof_advance_pairs(&edges, &faces, 0, 0, NULL, &error) == TUNNELPROOF_NULL);
  CHECK(strcmp(error.array, "step") == 0);
  step.positions = x;
  REFUSED(NULL, &faces, 0, 0, TUNNELPROOF_NULL, "edges");
  REFUSED(&edges, NULL, 0, 0, TUNNELPROOF_NULL, "faces");
  REFUSED(&edges, &faces, -1, 0, TUNNELPROOF_CLEARANCE, "clearance");
  REFUSED(&edges, &faces, NAN, 0, TUNNELPROOF_CLEARANCE, "clearance");
  REFUSED(&edges, &faces, 0, 1, TUNNELPROOF_CLEARANCE, "clearance");
  REFUSED(&edges, &faces, 1, 0.5, TUNNELPROOF_CLEARANCE, "clearance");
  faces.indices = NULL;
  REFUSED(&edges, &faces, 0, 0, TUNNELPROOF_NULL, "faces.indices");
  faces.indices = beyond;
  faces.pair_count = 1;
  REFUSED(&edges, &faces, 0, 0, TUNNELPROOF_INDEX, "faces.indices");
  CHECK(error.index == 0 && error.corner == 1 && error.value == 6);
  REFUSED(&faces, &edges, 0, 0, TUNNELPROOF_INDEX, "edges.indices");
  faces.indices = face_pairs;
  faces.radius_count = 1;
  REFUSED(&edges, &faces, 0, 0, TUNNELPROOF_NULL, "faces.radii");
  faces.radii = negative;
  REFUSED(&edges, &faces, 0, 0, TUNNELPROOF_RADIUS, "faces.radii");
  CHECK(error.index == 0 && error.corner == 1 && error.value == -1);
  faces.radii = at_first;
  faces.radius_count = 3;
  REFUSED(&edges, &faces, 0, 0, TUNNELPROOF_LENGTH, "faces.radii");
  CHECK(error.index == 1 && error.value == 3);
  faces.radius_count = 0;
  faces.end = NULL;
  REFUSED(&faces, &edges, 0, 0, TUNNELPROOF_NULL, "edges.end");
  memcpy(bad, at_last, sizeof bad);
  faces.end = bad;
  bad[7] = NAN;
  REFUSED(&edges, &faces, 0, 0, TUNNELPROOF_NOT_FINITE, "faces.end");
  CHECK(error.index == 2 && error.corner == 1 && error.value != error.value);
  /* Other positions, and as many as there should not be. Those that are equal may be elsewhere. */
  bad[7] = 1;
  REFUSED(&edges, &faces, 0, 0, TUNNELPROOF_POSITIONS, "faces");
  faces.end = at_last;
  faces.point_count = 5;
  REFUSED(&edges, &faces, 0, 0, TUNNELPROOF_POSITIONS, "faces");
  CHECK(step.step == -1);
  memcpy(bad, at_last, sizeof bad);
  faces.end = bad;
  faces.point_count = 6;
  CHECK(tunnelproof_advance_pairs(&edges, &faces, 0, 0, &step, &error) == 0);
#undef REFUSED
}

/* The same of positions that are float. */
static void refused_of_pairs_f32(void) {
  float first[18], other[18], x[18];
  const tunnelproof_pairs_f32 edges = {first, first, 6, edge_pairs, EDGE_PAIRS, NULL, 0};
  tunnelproof_pairs_f32 faces = {first, other, 6, face_pairs, FACE_PAIRS, NULL, 0};
  tunnelproof_pairs_step_f32 step = {NULL, NULL, 0, NULL, 0, -1, 0, 0};
  tunnelproof_error error;
  int i;

  for (i = 0; i < 18; i++) first[i] = other[i] = (float)at_first[i];
  CHECK(tunnelproof_advance_pairs_f32(&edges, &faces, 0, 0, &step, &error) == TUNNELPROOF_NULL);
  CHECK(strcmp(error.array, "positions") == 0);
  step.positions = x;
  CHECK(tunnelproof_advance_pairs_f32(&edges, &faces, -1, 0, &step, &error) ==
        TUNNELPROOF_CLEARANCE);
  CHECK(tunnelproof_advance_pairs_f32(&edges, NULL, 0, 0, &step, &error) == TUNNELPROOF_NULL);
  other[7] = 1;
  CHECK(tunnelproof_advance_pairs_f32(&edges, &faces, 0, 0, &step, &error) ==
        TUNNELPROOF_POSITIONS);
  other[7] = NAN;
  CHECK(tunnelproof_advance_pairs_f32(&edges, &faces, 0, 0, &step, &error) ==
        TUNNELPROOF_NOT_FINITE);
  CHECK(strcmp(error.array, "faces.end") == 0 && error.index == 2 && error.corner == 1);
  CHECK(step.step == -1);
  faces.end = first;
  CHECK(tunnelproof_advance_pairs_f32(&edges, &faces, 0, 0, &step, &error) == 0);
  CHECK(step.step == 1 && memcmp(x, first, sizeof x) == 0);
}

static void of_a_mesh(void) {
  tunnelproof_mesh *mesh = tunnelproof_mesh_new(6, edges, 1, faces, 1, NULL);
  uint32_t all[8];
  CHECK(mesh != NULL);
  CHECK(tunnelproof_mesh_edges(mesh, all, 4) == 4 && all[0] == 3 && all[1] == 4 && all[7] == 0);
  CHECK(tunnelproof_mesh_edges(NULL, all, 4) == TUNNELPROOF_NULL);
  contacts_of_a_mesh(mesh);
  steps_of_a_mesh(mesh);
  steps_as_of_a_mesh(mesh);
  of_a_mesh_in_f32(mesh);
  refused_of_a_mesh(mesh);
  tunnelproof_mesh_free(mesh);
}

int main(void) {
  size_t i;
  one_by_one();
  advanced();
  of_a_mesh();
  pairs_by_index();
  steps_of_pairs();
  refused_of_pairs();
  refused_of_pairs_f32();
  overlap();
  at_start();
  refused();
  turning();
  turning_refused();
  turning_in_batch();
  two_bodies();
  turning_vertex();
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
