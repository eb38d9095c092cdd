/* tunnelproof: continuous collision detection of two moving edges, and of a moving vertex and face,
 * without thresholds: no hit is false, no contact is missed, and the time of impact is the exact
 * one rounded down. Positions at that time are rounded, and may already be past the contact:
 * tunnelproof_advance_... and tunnelproof_mesh_step give positions to store, with a proof that
 * straight motion to them touches nothing.
 *
 * The proofs assume the floating-point environment that is the default of C: rounding to nearest
 * and gradual underflow. On x86 with SSE2 and on AArch64 each function sees to it: it sets that
 * environment and restores the caller's before it returns, so that fesetround, FTZ and DAZ (which
 * -ffast-math may set for a program) and exceptions that are not masked do not change any answer.
 * Exception flags that a function raises stay raised. Threads that the library starts have
 * the default environment. On other processors it is up to the caller.
 *
 * The points of a query are 24 numbers in metres: x, y, z of A, B, C, D at the start of the step,
 * then of A, B, C, D at its end. In between they move on straight lines. Edge-edge: the edges AB
 * and CD. Vertex-face: the vertex A and the face BCD. The first side is the edge AB or the vertex
 * A, the second is the edge CD or the face BCD. The radius of a query is the exact sum of two
 * numbers, such as the radii of two wires. Contact is a distance of at most the radius; with radius
 * 0, a common point.
 *
 * Buffers of queries: `points` has 24 doubles for each query, `radii` has 2, `verdicts` 1 int32_t
 * and `hits` 1 tunnelproof_hit. Those of meshes are described there. Each pointer is aligned for its
 * type. A buffer that is written must not overlap any other buffer of the call, unless it says so,
 * and nobody else may use it during the call. Buffers that are only read may overlap each other.
 * They must not change during the call.
 *
 * All functions may be called from any thread at any time, but for those that change or free a
 * mesh: nobody else may use the mesh during these. No function keeps a pointer. */
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
/* And of pairs, meshes and steps: a point, a vertex or a group that there is not, more vertices,
 * edges or faces than indices of 32 bits, fewer thicknesses than groups or radii than pairs, a
 * clearance below 0 or not finite, a share below 0 or not below 1, or both a clearance and a
 * share. */
#define TUNNELPROOF_INDEX (-4)
#define TUNNELPROOF_COUNT (-5)
#define TUNNELPROOF_LENGTH (-6)
#define TUNNELPROOF_CLEARANCE (-7)
/* And of bodies that turn: a quaternion is 0, or the body turns by more than 90 degrees. */
#define TUNNELPROOF_NO_ORIENTATION (-8)
#define TUNNELPROOF_TURNS_TOO_FAR (-9)
/* And of a step of pairs: the two lists do not have the same positions. */
#define TUNNELPROOF_POSITIONS (-10)

/* Whether the two sides pass through each other at the first contact (a crossing) or not (a graze).
 * With a radius: whether they do so within the step. After a graze they may cross later in the
 * step, so respond to both. */
enum tunnelproof_kind {
  TUNNELPROOF_CROSSING = 1,
  TUNNELPROOF_GRAZE = 2
};

/* How the two sides move relative to each other during the whole step. If several hold, the last in
 * this list. */
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
  /* The point on the first side at toi, in metres, rounded to double. */
  double point[3];
} tunnelproof_contact_point;

/* The first contact of a step, of either kind of query. */
typedef struct tunnelproof_hit {
  /* The largest double that is not above the time of impact, in [0, 1], and the smallest that is
   * not below it. Positions at toi are rounded to double, and may already be past the contact. */
  double toi, toi_above;
  /* A value of tunnelproof_kind, of this first contact. Exact. */
  int32_t kind;
  /* The sign of f just before the contact, which is the side they come from; 0 if f is always 0,
   * or at time 0. Exact. Of two edges f = ((B - A) x (D - C)) . (C - A), of a vertex and a
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
   * before the contact; of bodies that turn too, in space. 0, 0, 0 where there is none: they share a
   * point at the start of the step. */
  double normal[3];
  /* The distance of `normal` from the exact one is at most this, which is at most 2^-32. */
  double normal_error;
} tunnelproof_hit;

/* Decides one query. Returns TUNNELPROOF_MISS, TUNNELPROOF_HIT, or why it cannot be decided.
 * `points` are 24 numbers. `radii` are two, or NULL for radius 0. `hit` is written if the verdict
 * is TUNNELPROOF_HIT, and may be NULL. */
int32_t tunnelproof_decide_edge_edge(const double *points, const double *radii,
                                     tunnelproof_hit *hit);
int32_t tunnelproof_decide_vertex_face(const double *points, const double *radii,
                                       tunnelproof_hit *hit);

/* Decides `count` queries. Their points follow one another, and so do their radii unless `radii` is
 * NULL. `verdicts[i]` gets the verdict on query i. If it is TUNNELPROOF_HIT, `hits[i]` gets the
 * contact, unless `hits` is NULL. The other elements of `hits` stay as they are. Returns the number
 * of hits, or TUNNELPROOF_NULL. If `count` is 0, no pointer is read.
 *
 * The answers are those of the functions above, bit for bit. If few queries are hits, this is
 * faster. */
int64_t tunnelproof_decide_edge_edge_batch(const double *points, const double *radii, size_t count,
                                           int32_t *verdicts, tunnelproof_hit *hits);
int64_t tunnelproof_decide_vertex_face_batch(const double *points, const double *radii,
                                             size_t count, int32_t *verdicts,
                                             tunnelproof_hit *hits);

/* The same of rigid bodies that turn within the step. Edge-turning-edge: the edge AB moves on
 * straight lines, the edge CD is one of the body. Vertex-turning-face: the vertex A moves on a
 * straight line, the face BCD is one of the body.
 *
 * `points` are those in space at the start of the step, then at its end: 12 numbers, A, B, A, B, or 6,
 * A, A. `local` are those in the body's frame: 6 numbers, C and D, or 9, B, C and D. `poses` are 14
 * numbers: x, y, z of the body's centre in space and w, x, y, z of its quaternion at the start, then
 * at the end. `radii` are two numbers, or NULL for radius 0. All lengths are in metres.
 *
 * A point p of the body's frame is at c + R(q) p. Within the step the centre c and the quaternion q
 * both change at constant rates, so that the body passes through both poses exactly as they are
 * given. Quaternions may have any length but 0; q and -q mean the same, and the shorter turn is
 * taken. It may be 90 degrees at most: divide the step otherwise.
 *
 * The answer is as above, with the normal in space; `place_error` is at most 2^-50.
 * Where the body does not turn, it is that of the functions above. Ordinary contacts take
 * microseconds; grazes, ends of edges and times that are doubles mostly take less than some
 * milliseconds. No bound is stated: the slowest query found, with coordinates that span the range of
 * double, takes 5.4 s. */
int32_t tunnelproof_decide_edge_turning_edge(const double *points, const double *local,
                                             const double *poses, const double *radii,
                                             tunnelproof_hit *hit);
int32_t tunnelproof_decide_vertex_turning_face(const double *points, const double *local,
                                               const double *poses, const double *radii,
                                               tunnelproof_hit *hit);

/* Decides `count` queries, as the batches above: numbers of the same kind follow one another. */
int64_t tunnelproof_decide_edge_turning_edge_batch(const double *points, const double *local,
                                                   const double *poses, const double *radii,
                                                   size_t count, int32_t *verdicts,
                                                   tunnelproof_hit *hits);
int64_t tunnelproof_decide_vertex_turning_face_batch(const double *points, const double *local,
                                                     const double *poses, const double *radii,
                                                     size_t count, int32_t *verdicts,
                                                     tunnelproof_hit *hits);

/* Two bodies that both turn: an edge AB or a vertex A of the first one, an edge CD or a face BCD of the
 * second one. `local` are 12 numbers: A, B, C and D, each in the frame of its own body. `poses` are 28
 * numbers: the 14 of the first body, then those of the second one. The rest is as above. */
int32_t tunnelproof_decide_turning_edge_turning_edge(const double *local, const double *poses,
                                                     const double *radii, tunnelproof_hit *hit);
int32_t tunnelproof_decide_turning_vertex_turning_face(const double *local, const double *poses,
                                                       const double *radii, tunnelproof_hit *hit);
int64_t tunnelproof_decide_turning_edge_turning_edge_batch(const double *local,
                                                           const double *poses,
                                                           const double *radii, size_t count,
                                                           int32_t *verdicts,
                                                           tunnelproof_hit *hits);
int64_t tunnelproof_decide_turning_vertex_turning_face_batch(const double *local,
                                                             const double *poses,
                                                             const double *radii, size_t count,
                                                             int32_t *verdicts,
                                                             tunnelproof_hit *hits);

/* What is refused. A function that takes an error writes it if it returns a negative number, or no
 * mesh. It may be NULL. */
typedef struct tunnelproof_error {
  /* The number that is returned. */
  int32_t code;
  /* The name of the array or argument: "edges", "faces", "groups", "start", "end", "thickness",
   * "vertices", "clearance", "indices", "radii"; of a NULL that of the pointer. Where there are two
   * lists, their arrays are "edges.indices", "faces.radii" and so on. It lives as long as the
   * library. */
  const char *array;
  /* The place in it, from 0: `array[index][corner]`. Of TUNNELPROOF_LENGTH, `index` is how many
   * there should be. 0 where there is no place. */
  size_t index, corner;
  /* The value there, or how many there are; 0 where there is none. */
  double value;
} tunnelproof_error;

/* Queries that share points: candidate pairs as the broad phase of a mesh or of wires delivers
 * them. */
typedef struct tunnelproof_pairs {
  /* x, y, z of each point at the start of the step and at its end, in metres. */
  const double *start, *end;
  size_t point_count;
  /* The indices of A, B, C and D of each pair, four numbers below point_count. */
  const uint32_t *indices;
  size_t pair_count;
  /* Radii of two numbers each, in metres. The radius is 0 if radius_count is 0, the same for all if
   * that is 1, else there is one for each pair. */
  const double *radii;
  size_t radius_count;
} tunnelproof_pairs;

/* The same with positions that are float. */
typedef struct tunnelproof_pairs_f32 {
  const float *start, *end;
  size_t point_count;
  const uint32_t *indices;
  size_t pair_count;
  const double *radii;
  size_t radius_count;
} tunnelproof_pairs_f32;

/* A hit, and the pair whose it is: the place of its four indices, from 0. */
typedef struct tunnelproof_pair_hit {
  size_t pair;
  tunnelproof_hit hit;
} tunnelproof_pair_hit;

/* Decides pairs, by all threads if the library was built with them, and gives the same answers on
 * any number of them: those of tunnelproof_decide_edge_edge and tunnelproof_decide_vertex_face, bit
 * for bit. Writes at most `capacity` hits, in the order of the pairs, unless `hits` is NULL. Returns
 * how many there are.
 *
 * Returns a negative number, and writes nothing but `error`, for what is NULL (TUNNELPROOF_NULL), a
 * coordinate that is not finite (TUNNELPROOF_NOT_FINITE), a radius that is not a finite number of
 * at least 0 (TUNNELPROOF_RADIUS), neither one radius nor as many as pairs (TUNNELPROOF_LENGTH), or
 * an index that is not below `point_count` (TUNNELPROOF_INDEX). A pointer may be NULL if its count
 * is 0. */
int64_t tunnelproof_decide_edge_edge_pairs(const tunnelproof_pairs *pairs,
                                           tunnelproof_pair_hit *hits, size_t capacity,
                                           tunnelproof_error *error);
int64_t tunnelproof_decide_vertex_face_pairs(const tunnelproof_pairs *pairs,
                                             tunnelproof_pair_hit *hits, size_t capacity,
                                             tunnelproof_error *error);

/* The same of positions that are float, each of which is a double: nothing is copied or rounded. To
 * store `toi` as a float, round it down: where (float)toi is above it, use
 * nextafterf((float)toi, 0). */
int64_t tunnelproof_decide_edge_edge_pairs_f32(const tunnelproof_pairs_f32 *pairs,
                                               tunnelproof_pair_hit *hits, size_t capacity,
                                               tunnelproof_error *error);
int64_t tunnelproof_decide_vertex_face_pairs_f32(const tunnelproof_pairs_f32 *pairs,
                                                 tunnelproof_pair_hit *hits, size_t capacity,
                                                 tunnelproof_error *error);

/* Why a step is not a whole one. */
enum tunnelproof_blocked {
  /* A larger step would bring the two sides nearer than is kept, or a rounding error of that. */
  TUNNELPROOF_AHEAD = 1,
  /* The two sides come nearer, and start so near to what is kept that rounding has no room. A few
   * steps were tried; the largest of them that is proved is made, or none. */
  TUNNELPROOF_ROUNDING = 2,
  /* The two sides touch at the start, radius or not: no motion from there is apart. */
  TUNNELPROOF_TOUCHING = 3
};

/* A step of a query that is proved. */
typedef struct tunnelproof_advance {
  /* How much of the step is made, from 0 to 1. */
  double step;
  /* A, B, C and D to store, in metres: at a step of 1 the end, at 0 the start, bit for bit. */
  double points[12];
  /* Straight motion from the start to `points` keeps a distance above the exact sum of these two,
   * in metres. Exact. Both are 0 unless is_proved. */
  double kept[2];
  /* Whether any step is proved. If not, `step` is 0 and the points stay. */
  int32_t is_proved;
  /* A value of tunnelproof_blocked, or 0 if the step is a whole one. */
  int32_t blocked;
} tunnelproof_advance;

/* The largest step, within rounding, that keeps the two sides of a query apart by more than the
 * radius and a clearance, and the points to store. Straight motion to these points keeps that
 * distance exactly, in real arithmetic. The next step starts at them. So nothing ever passes
 * through anything, however many steps follow.
 *
 * `clearance` is in metres, 0 or more. Or it is 0, and `share` is not: two sides that would come
 * within the radius keep this share of what they have beyond it at the start, from 0 to below 1.
 *
 * Two sides that start nearer than that keep nine tenths of what they have beyond the radius, or of
 * their distance if they start within the radius; where rounding leaves no room even for that, they
 * keep the radius, or do not touch. They are free to part.
 *
 * Returns `advance->blocked`, or a negative number, with nothing written: TUNNELPROOF_NULL,
 * TUNNELPROOF_NOT_FINITE, TUNNELPROOF_RADIUS or TUNNELPROOF_CLEARANCE. `points` and `radii` are as
 * above. */
int32_t tunnelproof_advance_edge_edge(const double *points, const double *radii, double clearance,
                                      double share, tunnelproof_advance *advance);
int32_t tunnelproof_advance_vertex_face(const double *points, const double *radii,
                                        double clearance, double share,
                                        tunnelproof_advance *advance);

/* The same for engines that store float. If the coordinates at the start are floats, so are those of
 * `advance->points`: a cast to float changes nothing, and the proof is of what is stored. The end
 * may have more digits, as it is rounded to float first. There is less room: two sides that are
 * nearer than some 2^-21 of their coordinates, beyond what they keep, may be TUNNELPROOF_ROUNDING. */
int32_t tunnelproof_advance_edge_edge_f32(const double *points, const double *radii,
                                          double clearance, double share,
                                          tunnelproof_advance *advance);
int32_t tunnelproof_advance_vertex_face_f32(const double *points, const double *radii,
                                            double clearance, double share,
                                            tunnelproof_advance *advance);

/* The kind of a query, and of a list of pairs. */
enum tunnelproof_query_kind {
  TUNNELPROOF_EDGE_EDGE = 1,
  TUNNELPROOF_VERTEX_FACE = 2
};

/* A pair by its place in the list of its kind. */
typedef struct tunnelproof_listed_pair {
  /* Which list: a value of tunnelproof_query_kind. */
  int32_t kind;
  /* The place of its four indices, from 0. */
  size_t index;
} tunnelproof_listed_pair;

/* A pair that ends a step, and why: a value of tunnelproof_blocked. */
typedef struct tunnelproof_pairs_limit {
  tunnelproof_listed_pair pair;
  int32_t blocked;
} tunnelproof_pairs_limit;

/* A pair that keeps less than it should, as it starts nearer than that or as rounding leaves no room
 * for more. It keeps a distance above the exact sum of the two numbers, in metres. */
typedef struct tunnelproof_near_listed_pair {
  tunnelproof_listed_pair pair;
  double kept[2];
} tunnelproof_near_listed_pair;

/* A step of all points of pairs that is proved. */
typedef struct tunnelproof_pairs_step {
  /* Set before the call: where to write x, y, z of each point to store, in metres. It may be the
   * `start` or the `end` of the pairs. */
  double *positions;
  /* Set before the call: room for this many pairs that end the step, and that are near. A pointer may
   * be NULL: nothing is written there. The pairs are in order, edges first. */
  tunnelproof_pairs_limit *limits;
  size_t limit_capacity;
  tunnelproof_near_listed_pair *near_pairs;
  size_t near_capacity;
  /* How much of the step is made, from 0 to 1. At 1 the positions are those of the end, at 0 those
   * of the start, bit for bit. */
  double step;
  /* How many pairs end the step, 0 if it is a whole one, and how many are near. */
  size_t limit_count, near_count;
} tunnelproof_pairs_step;

/* The same with positions that are float. */
typedef struct tunnelproof_pairs_step_f32 {
  float *positions;
  tunnelproof_pairs_limit *limits;
  size_t limit_capacity;
  tunnelproof_near_listed_pair *near_pairs;
  size_t near_capacity;
  double step;
  size_t limit_count, near_count;
} tunnelproof_pairs_step_f32;

/* The largest step, within rounding, that keeps all pairs apart by more than their radius and a
 * clearance, and the positions to store, of all points. `edges` are pairs of edges, `faces` pairs of a
 * vertex and a face. Both are of the same points: their positions are equal, or the same arrays. A
 * list may be empty, with a `pair_count` of 0. `clearance` and `share`, and what pairs keep that start
 * too near, are as in tunnelproof_advance_edge_edge.
 *
 * Straight motion of all points from the start to `step->positions` keeps each pair that does not
 * touch at the start farther apart than that, exactly, in real arithmetic. A pair that is in neither
 * list stays apart as well, if the boxes around its two sides are farther apart, along an axis, than
 * its radius and the clearance. The box of a side is around all its points, at the start and at the
 * end together. The broad phase has to see to that, with its rounding outward. The next step starts
 * at the stored positions, with new lists. So nothing passes through anything in these pairs, however
 * many steps follow. Steps of parts of the lists are no step of the whole.
 *
 * The step is 0 if a pair touches at the start, radius or not, or if rounding leaves no room to any
 * step tried. `limits` names the pairs. Two sides that share a point touch always: leave them out.
 * Where TUNNELPROOF_ROUNDING ends a step, it may be as small as some rounding errors, so do not wait for
 * 0. Part these pairs, or let them move otherwise.
 *
 * Uses all threads if the library was built with them, and gives the same answers on any number of
 * them. Returns 0, or a negative number as tunnelproof_decide_edge_edge_pairs, also
 * TUNNELPROOF_CLEARANCE and TUNNELPROOF_POSITIONS. Nothing but `error` is written then. */
int32_t tunnelproof_advance_pairs(const tunnelproof_pairs *edges, const tunnelproof_pairs *faces,
                                  double clearance, double share, tunnelproof_pairs_step *step,
                                  tunnelproof_error *error);

/* The same for engines that store float. The positions to store are float, and the proof is of these
 * numbers. There is less room, as tunnelproof_advance_edge_edge_f32 says. */
int32_t tunnelproof_advance_pairs_f32(const tunnelproof_pairs_f32 *edges,
                                      const tunnelproof_pairs_f32 *faces, double clearance,
                                      double share, tunnelproof_pairs_step_f32 *step,
                                      tunnelproof_error *error);

/* Vertices, edges and faces by their indices: cloth, bodies, wires and points. Every edge may meet
 * every edge, and every vertex every face. A vertex in no edge is a point, which may also meet
 * edges and points. Parts that share a vertex never meet. */
typedef struct tunnelproof_mesh tunnelproof_mesh;

/* A new mesh of `vertex_count` vertices. `edges` has two indices of vertices for each edge, `faces`
 * three for each face. Both are copied. The edges of faces need not be given: those that are
 * missing come after those that are. A pointer may be NULL if its count is 0.
 *
 * Returns NULL and writes `error` if an index is not below `vertex_count` (TUNNELPROOF_INDEX) or
 * there are too many (TUNNELPROOF_COUNT). */
tunnelproof_mesh *tunnelproof_mesh_new(size_t vertex_count, const uint32_t *edges,
                                       size_t edge_count, const uint32_t *faces,
                                       size_t face_count, tunnelproof_error *error);

/* Frees a mesh. NULL is no mesh and is left alone. */
void tunnelproof_mesh_free(tunnelproof_mesh *mesh);

/* Puts each vertex into a group, a number from 0: `groups` has `vertex_count` of them, and is
 * copied. Without it all are of group 0. There is one group more than the largest number. What was
 * left out is forgotten. Returns 0 or a negative number. */
int32_t tunnelproof_mesh_set_groups(tunnelproof_mesh *mesh, const uint32_t *groups,
                                    tunnelproof_error *error);

/* Leaves out the pairs of two groups, which may be the same one. A static part is a group that is
 * left out with itself. A part with vertices of several groups is left out only if all its groups
 * are. Returns 0, or TUNNELPROOF_INDEX if there is no such group. */
int32_t tunnelproof_mesh_leave_out(tunnelproof_mesh *mesh, uint32_t first, uint32_t second,
                                   tunnelproof_error *error);

/* The edges, those given and then those of faces that were missing. Writes two indices for each
 * edge, of at most `capacity` edges, unless `edges` is NULL. Returns how many there are. */
int64_t tunnelproof_mesh_edges(const tunnelproof_mesh *mesh, uint32_t *edges, size_t capacity);

/* What is asked about a mesh: every vertex moves on a straight line from its position at the start
 * to that at the end. */
typedef struct tunnelproof_motion {
  /* x, y, z of each vertex, in metres. */
  const double *start, *end;
  /* Contact is a distance of at most the thickness, in metres. It is 0 if thickness_count is 0, the
   * same for all if that is 1, else there is one for each group. Two parts of different thickness
   * touch at the mean of both. */
  const double *thickness;
  size_t thickness_count;
} tunnelproof_motion;

/* The same with positions that are float. */
typedef struct tunnelproof_motion_f32 {
  const float *start, *end;
  const double *thickness;
  size_t thickness_count;
} tunnelproof_motion_f32;

/* What a side of a pair is. */
enum tunnelproof_feature {
  TUNNELPROOF_VERTEX = 1,
  /* An edge of tunnelproof_mesh_edges. */
  TUNNELPROOF_EDGE = 2,
  TUNNELPROOF_FACE = 3
};

/* Two edges, an edge or a point and a point, or a vertex and a face of a mesh. */
typedef struct tunnelproof_pair {
  /* A value of tunnelproof_feature, and its index. */
  int32_t first_feature;
  uint32_t first;
  int32_t second_feature;
  uint32_t second;
  /* The vertices A, B, C and D of its query. A point is both ends of its edge. */
  uint32_t vertices[4];
} tunnelproof_pair;

/* The first contact of a pair. All but `pair` is as in tunnelproof_hit. */
typedef struct tunnelproof_mesh_contact {
  tunnelproof_pair pair;
  double toi, toi_above;
  int32_t kind;
  int32_t has_second;
  tunnelproof_contact_point first, second;
  double normal[3];
} tunnelproof_mesh_contact;

/* The functions below use all threads, and give the same answers on any number of them. They return
 * a negative number, and write nothing but `error`, for what is NULL (TUNNELPROOF_NULL), a
 * coordinate that is not finite (TUNNELPROOF_NOT_FINITE), a thickness that is not a finite number
 * of at least 0 (TUNNELPROOF_RADIUS), or too few of these (TUNNELPROOF_LENGTH). */

/* The contact of the least time of impact; of several with the same `toi`, that of the first pair.
 * None is missed and none is false. Returns TUNNELPROOF_HIT or TUNNELPROOF_MISS. `contact` is
 * written if there is one, and may be NULL. */
int32_t tunnelproof_mesh_first_contact(const tunnelproof_mesh *mesh,
                                       const tunnelproof_motion *motion,
                                       tunnelproof_mesh_contact *contact,
                                       tunnelproof_error *error);

/* The first contact of each pair that touches, in an order that depends on the mesh alone. Writes
 * at most `capacity` of them, unless `contacts` is NULL. Returns how many there are. */
int64_t tunnelproof_mesh_all_contacts(const tunnelproof_mesh *mesh,
                                      const tunnelproof_motion *motion,
                                      tunnelproof_mesh_contact *contacts, size_t capacity,
                                      tunnelproof_error *error);

/* Whether no pair touches: 1 or 0. */
int32_t tunnelproof_mesh_is_free(const tunnelproof_mesh *mesh, const tunnelproof_motion *motion,
                                 tunnelproof_error *error);

/* The same of positions that are float: nothing is copied or rounded. */
int32_t tunnelproof_mesh_first_contact_f32(const tunnelproof_mesh *mesh,
                                           const tunnelproof_motion_f32 *motion,
                                           tunnelproof_mesh_contact *contact,
                                           tunnelproof_error *error);
int64_t tunnelproof_mesh_all_contacts_f32(const tunnelproof_mesh *mesh,
                                          const tunnelproof_motion_f32 *motion,
                                          tunnelproof_mesh_contact *contacts, size_t capacity,
                                          tunnelproof_error *error);
int32_t tunnelproof_mesh_is_free_f32(const tunnelproof_mesh *mesh,
                                     const tunnelproof_motion_f32 *motion,
                                     tunnelproof_error *error);

/* A pair that ends a step, and why: a value of tunnelproof_blocked. */
typedef struct tunnelproof_limit {
  tunnelproof_pair pair;
  int32_t blocked;
} tunnelproof_limit;

/* A pair that starts nearer than it should be kept. It keeps a distance above the exact sum of the
 * two numbers, in metres. */
typedef struct tunnelproof_near_pair {
  tunnelproof_pair pair;
  double kept[2];
} tunnelproof_near_pair;

/* A step of a mesh that is proved. */
typedef struct tunnelproof_step {
  /* Set before the call: where to write x, y, z of each vertex to store, in metres. It may be the
   * `start` or the `end` of the motion. */
  double *positions;
  /* Set before the call: room for this many pairs that end the step, and that start too near. A
   * pointer may be NULL: nothing is written there. */
  tunnelproof_limit *limits;
  size_t limit_capacity;
  tunnelproof_near_pair *near_pairs;
  size_t near_capacity;
  /* How much of the step is made, from 0 to 1. At 1 the positions are those of the end, at 0 those
   * of the start, bit for bit. */
  double step;
  /* How many pairs end the step, 0 if it is a whole one, and how many start too near. */
  size_t limit_count, near_count;
  /* How many pairs of edges or points, and of a vertex and a face, had swept boxes so near that
   * they were looked at. */
  size_t candidates[2];
} tunnelproof_step;

/* The same with positions that are float. */
typedef struct tunnelproof_step_f32 {
  float *positions;
  tunnelproof_limit *limits;
  size_t limit_capacity;
  tunnelproof_near_pair *near_pairs;
  size_t near_capacity;
  double step;
  size_t limit_count, near_count;
  size_t candidates[2];
} tunnelproof_step_f32;

/* The largest step, within rounding, that keeps all pairs apart by more than the thickness and a
 * clearance, and the positions to store. Straight motion from `start` to these keeps each pair
 * farther apart than that, exactly, in real arithmetic. The next step starts at them. So nothing
 * ever passes through anything, however many steps follow. `clearance` and `share`, and what pairs
 * keep that start too near, are as in tunnelproof_advance_edge_edge, with the thickness as radius.
 *
 * The step is 0 if a pair touches at the start, thickness or not, or if rounding leaves no room to
 * any step tried. `limits` names the pairs. Do not ask again with the same motion.
 *
 * Returns 0 or a negative number, also TUNNELPROOF_CLEARANCE. */
int32_t tunnelproof_mesh_step(const tunnelproof_mesh *mesh, const tunnelproof_motion *motion,
                              double clearance, double share, tunnelproof_step *step,
                              tunnelproof_error *error);

/* The same for engines that store float. The positions to store are float, and the proof is of these
 * numbers. There is less room, as tunnelproof_advance_edge_edge_f32 says. */
int32_t tunnelproof_mesh_step_f32(const tunnelproof_mesh *mesh,
                                  const tunnelproof_motion_f32 *motion, double clearance,
                                  double share, tunnelproof_step_f32 *step,
                                  tunnelproof_error *error);

/* The version of the library, "0.1.0". */
const char *tunnelproof_version(void);

#ifdef __cplusplus
}
#endif

#endif
