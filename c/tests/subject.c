/* The library as a subject of `tunnelproof certify --subject lib:`, with both headers in a file. */
#include "tunnelproof_subject.h"

#include "tunnelproof.h"

static int answer(int32_t verdict, const tunnelproof_hit *hit, double *toi) {
  if (verdict == TUNNELPROOF_HIT) *toi = hit->toi;
  return verdict;
}

int tunnelproof_edge_edge(const double points[24], const double radius[2], double *toi) {
  tunnelproof_hit hit;
  return answer(tunnelproof_decide_edge_edge(points, radius, &hit), &hit, toi);
}

int tunnelproof_vertex_face(const double points[24], const double radius[2], double *toi) {
  tunnelproof_hit hit;
  return answer(tunnelproof_decide_vertex_face(points, radius, &hit), &hit, toi);
}
