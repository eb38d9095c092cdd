/* Bodies that turn, against the oracle: queries are written as lines of JSON, and what the program
 * that is the argument answers with `eval --turning` is compared with the library's answers. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* popen */
#endif
#include "tunnelproof.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { COUNT = 600, LINE = 4096 };

/* A query of either kind: A, B, A, B or A, A; C, D or B, C, D. */
typedef struct {
  int is_face;
  double points[12], local[9], poses[14], radii[2];
} query;

static query queries[COUNT];

/* A number in [-1, 1) of a generator that is the same everywhere. */
static double drawn(void) {
  static uint64_t state = 29;
  state = state * 6364136223846793005u + 1442695040888963407u;
  return (double)(int32_t)(state >> 32) / 2147483648.0;
}

/* Of every second query a small integer, so that degenerate ones are frequent. */
static double coordinate(int is_lattice) { return is_lattice ? floor(2.5 * drawn() + 0.5) : drawn(); }

static void draw(query *out, int index) {
  const int is_lattice = index / 2 % 2;
  int k;
  out->is_face = index % 2;
  for (k = 0; k < 12; k++) out->points[k] = coordinate(is_lattice);
  for (k = 0; k < 9; k++) out->local[k] = coordinate(is_lattice);
  /* At most 25 degrees from no turn at the start and 47 at the end. */
  for (k = 0; k < 14; k++)
    out->poses[k] = coordinate(is_lattice) / (k % 7 < 3 ? 4 : k < 7 ? 16 : 8);
  out->poses[3] = 1;
  out->poses[10] = index % 3 ? 1 : -1;
  for (k = 0; k < 2; k++) out->radii[k] = drawn() < 0 ? 0 : floor(2 * fabs(drawn()) + 0.5) / 8;
}

static void write_rows(FILE *file, const char *name, const double *numbers, int rows, int columns) {
  int row, column;
  fprintf(file, "\"%s\":[", name);
  for (row = 0; row < rows; row++) {
    for (column = 0; column < columns; column++)
      fprintf(file, "%s%.17g", column ? "," : row ? ",[" : "[", numbers[columns * row + column]);
    fprintf(file, "]");
  }
  fprintf(file, "],");
}

static void write_query(FILE *file, const query *of, int index) {
  fprintf(file, "{\"id\":\"%d\",\"kind\":\"%s\",", index,
          of->is_face ? "vertex-turning-face" : "edge-turning-edge");
  write_rows(file, "points", of->points, of->is_face ? 2 : 4, 3);
  write_rows(file, "local", of->local, of->is_face ? 3 : 2, 3);
  write_rows(file, "poses", of->poses, 2, 7);
  fprintf(file, "\"radius\":[%.17g,%.17g]}\n", of->radii[0], of->radii[1]);
}

/* The number after a text in a line; NAN if the text is not there. */
static double number(const char *line, const char *text) {
  const char *found = strstr(line, text);
  return found ? strtod(found + strlen(text), NULL) : NAN;
}

static int says(const char *line, const char *text) { return strstr(line, text) != NULL; }

static int is_between(double value, const char *line, const char *name, double error) {
  char text[32];
  double below, above;
  sprintf(text, "\"%s\":{\"below\":", name);
  below = number(line, text);
  above = number(strstr(line, text), "\"above\":");
  error += ldexp(1, -53);
  return below - error <= value && value <= above + error;
}

/* Whether the normal is a unit vector, or missing where they may share a point at the start. */
static int is_normal(const tunnelproof_hit *hit) {
  const double *n = hit->normal;
  const double square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
  if (square == 0) return hit->toi_above == 0 && hit->normal_error == 0;
  return fabs(square - 1) < 1e-14 && hit->normal_error > 0 && hit->normal_error <= ldexp(1, -32);
}

static int is_same(const tunnelproof_hit *hit, const query *of, const char *line) {
  static const char *cases[] = {"", "general", "coplanar", "parallel", "collinear", "shared-start",
                                "degenerate"};
  const double *weights = hit->first.weights;
  char motion_case[40];
  sprintf(motion_case, "\"case\":\"%s\"", cases[hit->motion_case]);
  return hit->toi == number(line, "\"toi\":{\"below\":") &&
         hit->toi_above == number(strstr(line, "\"toi\":"), "\"above\":") &&
         (hit->kind == TUNNELPROOF_CROSSING) == says(line, "\"kind_of_contact\":\"crossing\"") &&
         hit->side == number(line, "\"side\":") && says(line, motion_case) &&
         hit->temporarily_parallel == says(line, "\"temporarily_parallel\":true") &&
         hit->temporarily_point == says(line, "\"temporarily_point\":true") &&
         hit->place_error <= ldexp(1, -50) && is_normal(hit) &&
         is_between(weights[of->is_face ? 2 : 1], line, "u", hit->place_error) &&
         is_between(weights[3], line, "v", hit->place_error);
}

int main(int argc, char **argv) {
  char command[LINE], line[LINE];
  int index, hits = 0, answers = 0, failures = 0;
  FILE *file;
  if (argc != 3) {
    printf("usage: turning PROGRAM FILE; the file is written\n");
    return 2;
  }
  file = fopen(argv[2], "w");
  if (file == NULL) return 2;
  for (index = 0; index < COUNT; index++) {
    draw(&queries[index], index);
    write_query(file, &queries[index], index);
  }
  if (fclose(file) != 0) return 2;
  snprintf(command, sizeof command, "'%s' eval --turning '%s'", argv[1], argv[2]);
  file = popen(command, "r");
  while (file != NULL && answers < COUNT && fgets(line, sizeof line, file) != NULL) {
    const query *of = &queries[answers];
    tunnelproof_hit hit;
    const int32_t verdict = (of->is_face ? tunnelproof_decide_vertex_turning_face
                                         : tunnelproof_decide_edge_turning_edge)(
        of->points, of->local, of->poses, of->radii, &hit);
    const int is_hit = says(line, "\"hit\":true");
    answers += 1;
    hits += is_hit;
    if (verdict == is_hit && (!is_hit || is_same(&hit, of, line))) continue;
    printf("verdict %d, toi %.17g, but the oracle says %s", (int)verdict, hit.toi, line);
    failures += 1;
  }
  if (file == NULL || pclose(file) != 0 || answers != COUNT || hits < COUNT / 20 || hits == COUNT)
    failures += 1;
  printf("%d queries of bodies that turn, %d hits, %d failures\n", answers, hits, failures);
  return failures != 0;
}
