// The certified path as a narrow phase of IPC Toolkit in C++: a `NarrowPhaseCCD` for every function of
// the toolkit that takes one, such as `ipc::compute_collision_free_stepsize`. Made for version 1.6.1.
//
// What it does with a pair near `min_distance`:
//
// - A pair that would come within `min_distance` keeps a `share` of what it has beyond it, 0.2 by
//   default.
// - A pair that starts within `min_distance` keeps nine tenths of its distance, and is free to part.
// - The time of impact is 0 only if a pair touches at the start, or if rounding leaves no room to move.
//   Do not ask again with the same motion.
//
// Each pair is decided without error, but alone: rounding of stored positions is accounted for in the
// pair that ends the step, not in the others. tunnelproof_mesh_step accounts for it in all. A pair with
// coordinates that are not finite ends the step at 0.
//
// Calls are independent: any number of threads may make them.
#pragma once

#include <tunnelproof.h>

#include <ipc/ccd/narrow_phase_ccd.hpp>

#include <algorithm>
#include <array>

namespace tunnelproof {

class CertifiedCCD : public ipc::NarrowPhaseCCD {
    using Point = Eigen::ConstRef<ipc::VectorMax3d>;
    using Point3 = Eigen::ConstRef<Eigen::Vector3d>;

public:
    explicit CertifiedCCD(double share = 0.2) : m_share(share) {}

    bool point_point_ccd(Point p0, Point q0, Point p1, Point q1, double& toi,
                         const double min_distance = 0.0, const double tmax = 1.0) const override
    {
        return ccd(edges, packed({ p0, p0, q0, q0, p1, p1, q1, q1 }), min_distance, tmax, toi);
    }

    bool point_edge_ccd(Point p0, Point a0, Point b0, Point p1, Point a1, Point b1, double& toi,
                        const double min_distance = 0.0, const double tmax = 1.0) const override
    {
        return ccd(edges, packed({ p0, p0, a0, b0, p1, p1, a1, b1 }), min_distance, tmax, toi);
    }

    bool point_triangle_ccd(Point3 p0, Point3 a0, Point3 b0, Point3 c0, Point3 p1, Point3 a1,
                            Point3 b1, Point3 c1, double& toi, const double min_distance = 0.0,
                            const double tmax = 1.0) const override
    {
        return ccd(face, packed({ p0, a0, b0, c0, p1, a1, b1, c1 }), min_distance, tmax, toi);
    }

    bool edge_edge_ccd(Point3 a0, Point3 b0, Point3 c0, Point3 d0, Point3 a1, Point3 b1, Point3 c1,
                       Point3 d1, double& toi, const double min_distance = 0.0,
                       const double tmax = 1.0) const override
    {
        return ccd(edges, packed({ a0, b0, c0, d0, a1, b1, c1, d1 }), min_distance, tmax, toi);
    }

private:
    using Points = std::array<double, 24>;

    struct Kind {
        decltype(&tunnelproof_decide_edge_edge) decide;
        decltype(&tunnelproof_advance_edge_edge) advance;
    };

    static constexpr Kind edges { tunnelproof_decide_edge_edge, tunnelproof_advance_edge_edge };
    static constexpr Kind face { tunnelproof_decide_vertex_face, tunnelproof_advance_vertex_face };

    // Points in the plane get a third coordinate of 0.
    template <typename Corners> static Points pack(const Corners& corners)
    {
        Points points {};
        for (std::size_t i = 0; i < corners.size(); ++i)
            std::copy_n(corners[i].data(), corners[i].size(), &points[3 * i]);
        return points;
    }
    static Points packed(const std::array<ipc::VectorMax3d, 8>& corners) { return pack(corners); }

    bool ccd(const Kind& kind, const Points& points, double min_distance, double tmax,
             double& toi) const
    {
        const double radii[2] = { min_distance, 0.0 };
        toi = tmax;
        tunnelproof_hit hit {};
        const int32_t verdict = kind.decide(points.data(), radii, &hit);
        if (verdict == TUNNELPROOF_MISS || (verdict == TUNNELPROOF_HIT && hit.toi_above > tmax))
            return false;
        tunnelproof_advance moved {};
        const int32_t blocked = kind.advance(points.data(), radii, 0.0, m_share, &moved);
        // It starts within the distance, and parts.
        if (blocked == 0)
            return false;
        toi = blocked < 0 ? 0.0 : std::min(moved.step, tmax);
        return true;
    }

    double m_share;
};

} // namespace tunnelproof
