// Calls the narrow phase of certified_ccd.hpp as IPC Toolkit does. Ends with 1 if an answer is wrong.
#include "certified_ccd.hpp"

#include <cmath>
#include <cstdio>

int main()
{
    using V = Eigen::Vector3d;
    const tunnelproof::CertifiedCCD certified;
    const ipc::NarrowPhaseCCD& ccd = certified;
    int wrong = 0;
    const auto expect = [&](const char* what, bool is_right) {
        if (!is_right)
            std::printf("wrong: %s\n", what);
        wrong += !is_right;
    };
    double toi = -1.0;
    const V a(-1, 0, 0), b(1, 0, 0), c(0, -1, 1), d(0, 1, 1), down(0, 0, -2);
    // Four fifths of the way to the contact at 1/2.
    expect("edges meet", ccd.edge_edge_ccd(a, b, c, d, a, b, c + down, d + down, toi));
    expect("edges keep a fifth", std::abs(toi - 0.4) < 1e-6);
    expect("edges meet later", !ccd.edge_edge_ccd(a, b, c, d, a, b, c + down, d + down, toi, 0, 0.4));
    expect("edges part", !ccd.edge_edge_ccd(a, b, c, d, a, b, c - down, d - down, toi, 2.0));
    const V t0(0, 0, 0), t1(1, 0, 0), t2(0, 1, 0), p(0.25, 0.25, 1);
    expect("a vertex meets a face",
           ccd.point_triangle_ccd(p, t0, t1, t2, p + down, t0, t1, t2, toi, 0.5));
    expect("and keeps a fifth of what it has", std::abs(toi - 0.2) < 1e-6);
    expect("a point meets an edge",
           ccd.point_edge_ccd(V(0, 0, 1), a, b, V(0, 0, -1), a, b, toi));
    expect("points in the plane meet",
           ccd.point_point_ccd(Eigen::Vector2d(0, 1), Eigen::Vector2d(0, 0), Eigen::Vector2d(0, -1),
                               Eigen::Vector2d(0, 0), toi));
    expect("they touch at the start", ccd.edge_edge_ccd(a, b, a, c, a, b, a, c, toi) && toi == 0.0);
    expect("no number ends the step",
           ccd.edge_edge_ccd(a, b, c, d, a, b, c * NAN, d, toi) && toi == 0.0);
    return wrong > 0;
}
