/* The library in every floating-point environment of its caller: the bits of every answer are those
 * of the default one, the environment is the caller's after each call, and nothing hangs.
 *
 * Each environment has a process of its own, whose first calls are made in it, so that the threads
 * for meshes are started there. TUNNELPROOF_QUERIES sets the number of queries in each; with
 * arguments, only the environments of these names are taken. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* feenableexcept, fork */
#endif
#include "tunnelproof.h"

#include <fenv.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#if defined(__x86_64__) || defined(__SSE2__)
#include <xmmintrin.h>
#define HAS_REGISTER 1
#define FLUSH 0x8040ul /* FTZ and DAZ */

/* What controls the operations: all of MXCSR but the flags of exceptions. */
static unsigned long control(void) { return _mm_getcsr() & 0xffc0; }
static void add_control(unsigned long bits) { _mm_setcsr(_mm_getcsr() | (unsigned)bits); }
#elif defined(__aarch64__)
#define HAS_REGISTER 1
#define FLUSH (1ul << 24) /* FZ */

static unsigned long control(void) {
  unsigned long word;
  __asm__ volatile("mrs %0, fpcr" : "=r"(word));
  return word;
}
static void add_control(unsigned long bits) {
  __asm__ volatile("msr fpcr, %0" : : "r"(control() | bits));
}
#else
#define HAS_REGISTER 0
#define FLUSH 0ul

static unsigned long control(void) { return (unsigned long)fegetround(); }
static void add_control(unsigned long bits) { (void)bits; }
#endif

typedef struct {
  const char *name;
  int rounding;
  unsigned long bits;
  /* Exceptions that interrupt the program. */
  int exceptions;
} environment;

static const environment environments[] = {
    {"nearest", FE_TONEAREST, 0, 0},
    {"downward", FE_DOWNWARD, 0, 0},
    {"upward", FE_UPWARD, 0, 0},
    {"toward-zero", FE_TOWARDZERO, 0, 0},
    {"flush-to-zero", FE_TONEAREST, FLUSH, 0},
    {"flush-to-zero-upward", FE_UPWARD, FLUSH, 0},
    {"exceptions", FE_TONEAREST, 0, FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW},
};

static void enter(const environment *which) {
  fesetround(which->rounding);
  if (which->bits) add_control(which->bits);
  if (which->exceptions) {
    feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(which->exceptions);
  }
}

static void leave(void) { fesetenv(FE_DFL_ENV); }

/* Meshes take longer, and are asked about in one block of so many. */
enum { BLOCK = 1000, MESH_BLOCKS = 50, PAIRS = 8, VERTICES = 4 * PAIRS, CONTACTS = 256 };

/* So many queries of bodies that turn in each block. */
enum { TURNING = 50 };

/* Queries, and a mesh that is made of the first of them. */
typedef struct {
  double points[24 * BLOCK];
  double radii[2 * BLOCK];
  /* Of ordinary size, and subnormal. */
  double start[2][3 * VERTICES], end[2][3 * VERTICES];
  double poses[14 * TURNING];
} questions;

/* What is answered. Everything that is not written stays 0. */
typedef struct {
  int32_t verdicts[BLOCK];
  tunnelproof_hit hits[BLOCK];
  int32_t blocked[BLOCK];
  tunnelproof_advance advances[BLOCK];
  int64_t hit_count[2];
  int32_t batch_verdicts[2][BLOCK];
  tunnelproof_hit batch_hits[2][BLOCK];
  int64_t contact_count[2];
  tunnelproof_mesh_contact first[2], contacts[2][CONTACTS];
  int32_t is_free[2];
  double positions[2][3 * VERTICES], steps[2];
  size_t counts[2][4];
  double pair_positions[2][3 * VERTICES], pair_steps[2];
  size_t pair_counts[2][2];
  int32_t turning_verdicts[2][TURNING];
  tunnelproof_hit turning_hits[2][TURNING];
  int64_t turning_count;
  int32_t turning_batch_verdicts[TURNING];
  tunnelproof_hit turning_batch_hits[TURNING];
  tunnelproof_limit limits[2][CONTACTS];
  tunnelproof_near_pair near_pairs[2][CONTACTS];
  /* How often the environment was not the caller's after a call. */
  int changed;
} answers;

static questions asked;
static answers there, here;
static tunnelproof_mesh *mesh;

/* A random integer of so many bits, from a generator that is the same everywhere. */
static uint64_t state;
static uint64_t bits(int count) {
  state = state * 6364136223846793005u + 1442695040888963407u;
  return (state ^ state >> 29) >> 16 & ((1ull << count) - 1);
}

/* A number in [-1, 1). */
static double drawn(void) { return ldexp((double)bits(33), -32) - 1; }

/* A coordinate of a query of some family. */
static double coordinate(int family) {
  switch (family) {
    case 0: return drawn();
    case 1: return (double)(int)bits(2) - 1;                     /* degenerate, in integers */
    case 2: return ldexp((double)(int)bits(4) - 8, -1074);       /* subnormal, few bits */
    case 3: return ldexp(drawn(), -1030);                        /* subnormal */
    case 4: return 1 + ldexp((double)(int)bits(3) - 4, -52);     /* cancellation */
    case 5: return bits(1) ? drawn() : ldexp(drawn(), -1022);    /* both */
    case 6: return ldexp(drawn(), (int)bits(5) - 16);            /* magnitudes */
    default: return ldexp(drawn(), (int)bits(11) - 1074);        /* all exponents */
  }
}

static double radius(int family) {
  switch (family) {
    case 1: return (double)bits(1) / 2;
    case 2: return ldexp((double)bits(2), -1074);
    case 3: return ldexp((double)bits(20), -1060);
    case 4: return ldexp((double)bits(3), -53);
    case 7: return 0;
    default: return ldexp((double)bits(20), -26);
  }
}

/* Families that the integers decide are slower, and come less often. */
static int family_of(size_t index) {
  static const int most[16] = {0, 6, 0, 2, 0, 3, 0, 6, 0, 4, 0, 6, 0, 6, 0, 3};
  if (index % 500 == 499) return 7;
  if (index % 100 == 49) return 5;
  if (index % 50 == 24) return 1;
  return most[index % 16];
}

static void draw(size_t block) {
  size_t i, k;
  state = 0x9e3779b97f4a7c15u * (block + 1);
  for (i = 0; i < BLOCK; i++) {
    const int family = family_of(i);
    double *points = asked.points + 24 * i;
    for (k = 0; k < 24; k++) points[k] = coordinate(family);
    /* Some of them meet for certain: one side falls through the other. */
    if (family != 1 && bits(1))
      for (k = 0; k < 12; k++) points[12 + k] = k == 8 || k == 11 ? -points[k] : points[k];
    for (k = 0; k < 2; k++) asked.radii[2 * i + k] = bits(1) ? radius(family) : 0;
    if (bits(family == 0 ? 1 : 4)) asked.radii[2 * i] = asked.radii[2 * i + 1] = 0;
  }
  for (i = 0; i < TURNING; i++) {
    const double size = i % 3 ? 1 : ldexp(1, -1060);
    for (k = 0; k < 14; k++) {
      const int is_centre = k % 7 < 3;
      asked.poses[14 * i + k] = is_centre ? coordinate(family_of(i)) / 4 : size * drawn() / 4;
    }
    asked.poses[14 * i + 3] = asked.poses[14 * i + 10] = size;
  }
  for (i = 0; i < 3 * VERTICES; i++) {
    asked.start[0][i] = drawn();
    asked.end[0][i] = asked.start[0][i] + drawn() / 4;
    asked.start[1][i] = ldexp(asked.start[0][i], -1040);
    asked.end[1][i] = ldexp(asked.end[0][i], -1040);
  }
}

/* Two edges and a face of each four vertices. */
static tunnelproof_mesh *new_mesh(void) {
  uint32_t edges[4 * PAIRS], faces[3 * PAIRS], q, k;
  for (q = 0; q < PAIRS; q++) {
    for (k = 0; k < 4; k++) edges[4 * q + k] = 4 * q + k;
    for (k = 0; k < 3; k++) faces[3 * q + k] = 4 * q + 1 + k;
  }
  return tunnelproof_mesh_new(VERTICES, edges, 2 * PAIRS, faces, PAIRS, NULL);
}

static void ask_of_mesh(answers *out, int i) {
  static const double thicknesses[2] = {0.001, 0};
  static const double clearances[2] = {0.001, 1e-316};
  const tunnelproof_motion motion = {asked.start[i], asked.end[i], thicknesses + i, 1};
  tunnelproof_step step;
  memset(&step, 0, sizeof step);
  step.positions = out->positions[i];
  step.limits = out->limits[i];
  step.near_pairs = out->near_pairs[i];
  step.limit_capacity = step.near_capacity = CONTACTS;
  out->is_free[i] = tunnelproof_mesh_is_free(mesh, &motion, NULL);
  tunnelproof_mesh_first_contact(mesh, &motion, &out->first[i], NULL);
  out->contact_count[i] =
      tunnelproof_mesh_all_contacts(mesh, &motion, out->contacts[i], CONTACTS, NULL);
  tunnelproof_mesh_step(mesh, &motion, clearances[i], 0, &step, NULL);
  memcpy(&out->steps[i], &step.step, sizeof step.step);
  out->counts[i][0] = step.limit_count;
  out->counts[i][1] = step.near_count;
  memcpy(out->counts[i] + 2, step.candidates, sizeof step.candidates);
}

/* Edges and faces of four vertices, and of the next four. */
static void ask_of_pairs(answers *out, int i) {
  static const double radii[2][2] = {{0.001, 0}, {0, 0}}, clearances[2] = {0.001, 1e-316};
  uint32_t edge_pairs[4 * PAIRS], face_pairs[4 * PAIRS], q, k;
  const tunnelproof_pairs edges = {asked.start[i], asked.end[i], VERTICES, edge_pairs, PAIRS,
                                   radii[i], 1};
  const tunnelproof_pairs faces = {asked.start[i], asked.end[i], VERTICES, face_pairs, PAIRS,
                                   radii[i], 1};
  tunnelproof_pairs_step step;
  for (q = 0; q < PAIRS; q++)
    for (k = 0; k < 4; k++) {
      edge_pairs[4 * q + k] = (4 * q + 2 + k) % VERTICES;
      face_pairs[4 * q + k] = (4 * q + 3 + k) % VERTICES;
    }
  memset(&step, 0, sizeof step);
  step.positions = out->pair_positions[i];
  tunnelproof_advance_pairs(&edges, &faces, clearances[i], 0, &step, NULL);
  memcpy(&out->pair_steps[i], &step.step, sizeof step.step);
  out->pair_counts[i][0] = step.limit_count;
  out->pair_counts[i][1] = step.near_count;
}

/* Points in space and of the body are those of the other queries. */
static void ask_of_bodies(answers *out) {
  const double *points = asked.points, *poses = asked.poses, *radii = asked.radii;
  size_t i;
  for (i = 0; i < TURNING; i++) {
    out->turning_verdicts[0][i] = tunnelproof_decide_edge_turning_edge(
        points + 24 * i, points + 24 * i + 12, poses + 14 * i, radii + 2 * i,
        &out->turning_hits[0][i]);
    out->turning_verdicts[1][i] = tunnelproof_decide_vertex_turning_face(
        points + 24 * i, points + 24 * i + 12, poses + 14 * i, radii + 2 * i,
        &out->turning_hits[1][i]);
  }
  out->turning_count = tunnelproof_decide_edge_turning_edge_batch(
      points, points + 12 * TURNING, poses, radii, TURNING, out->turning_batch_verdicts,
      out->turning_batch_hits);
}

/* Asks everything. No number is computed here: that would depend on the environment. */
static void ask(answers *out, int of_mesh) {
  const unsigned long own = control();
  const int rounding = fegetround();
  size_t i;
  memset(out, 0, sizeof *out);
  for (i = 0; of_mesh && i < 2; i++) {
    ask_of_mesh(out, (int)i);
    out->changed += control() != own;
    ask_of_pairs(out, (int)i);
    out->changed += control() != own;
  }
  for (i = 0; i < BLOCK; i++) {
    const double *points = asked.points + 24 * i, *radii = asked.radii + 2 * i;
    const int is_face = i / 8 % 2;
    out->verdicts[i] = (is_face ? tunnelproof_decide_vertex_face : tunnelproof_decide_edge_edge)(
        points, radii, &out->hits[i]);
    out->changed += control() != own;
    if (i % 7 == 0) {
      /* A clearance that is subnormal is not 0: it and a share are refused. */
      const double share = i % 2 ? 0.5 : 0, clearance = i % 5 == 0 ? 1e-313 : 0;
      out->blocked[i] =
          (is_face ? tunnelproof_advance_vertex_face : tunnelproof_advance_edge_edge)(
              points, radii, clearance, share, &out->advances[i]);
      out->changed += control() != own;
    }
  }
  ask_of_bodies(out);
  out->changed += control() != own;
  out->hit_count[0] = tunnelproof_decide_edge_edge_batch(asked.points, NULL, BLOCK,
                                                         out->batch_verdicts[0],
                                                         out->batch_hits[0]);
  out->changed += control() != own;
  out->hit_count[1] = tunnelproof_decide_vertex_face_batch(asked.points, NULL, BLOCK,
                                                           out->batch_verdicts[1],
                                                           out->batch_hits[1]);
  out->changed += control() != own || fegetround() != rounding;
}

/* Asks so many queries in an environment and in the default one; how many blocks differ. */
static int compare(const environment *which, size_t count) {
  const unsigned long own = control();
  size_t block, hits = 0, turning = 0, i;
  int failures = 0;
  for (block = 0; block * BLOCK < count && failures < 10; block++) {
    /* What hangs is ended by the signal. */
    alarm(120);
    draw(block);
    enter(which);
    if (mesh == NULL) mesh = new_mesh();
    ask(&there, block % MESH_BLOCKS == 0);
    leave();
    ask(&here, block % MESH_BLOCKS == 0);
    if (there.changed) {
      printf("%s: block %zu: the environment has changed %d times\n", which->name, block,
             there.changed);
      failures += 1;
    }
    if (here.changed || control() != own) failures += 1;
    there.changed = here.changed = 0;
    for (i = 0; i < TURNING; i++)
      turning += (here.turning_verdicts[0][i] == TUNNELPROOF_HIT) +
                 (here.turning_verdicts[1][i] == TUNNELPROOF_HIT);
    for (i = 0; i < BLOCK; i++) hits += here.verdicts[i] == TUNNELPROOF_HIT;
    if (memcmp(&there, &here, sizeof here) != 0) {
      int one = -1;
      for (i = BLOCK; i > 0; i--)
        if (there.verdicts[i - 1] != here.verdicts[i - 1] ||
            memcmp(&there.hits[i - 1], &here.hits[i - 1], sizeof *here.hits) != 0)
          one = (int)i - 1;
      printf("%s: block %zu: other answers, ", which->name, block);
      if (one < 0) printf("of a batch, a step, a mesh, pairs or a body that turns\n");
      else printf("at first to query %d\n", one);
      failures += 1;
    }
  }
  printf("%-22s %zu queries, %zu hits, %zu of bodies that turn, %d failures\n", which->name,
         block * BLOCK, hits, turning, failures);
  return failures;
}

int main(int argc, char **argv) {
  const char *asked_for = getenv("TUNNELPROOF_QUERIES");
  const size_t count = asked_for ? strtoul(asked_for, NULL, 10) : 20000;
  size_t i;
  int failures = 0, k;
  for (i = 0; i < sizeof environments / sizeof *environments; i++) {
    int is_taken = argc == 1, status = 0;
    for (k = 1; k < argc; k++) is_taken |= strcmp(argv[k], environments[i].name) == 0;
    if (!is_taken || (!HAS_REGISTER && environments[i].bits)) continue;
    fflush(stdout);
    if (fork() == 0) exit(compare(&environments[i], count) != 0);
    wait(&status);
    if (status != 0) {
      printf("%s: failed%s\n", environments[i].name, WIFSIGNALED(status) ? ", by a signal" : "");
      failures += 1;
    }
  }
  return failures != 0;
}
