// c++ -std=c++17 test.cpp $(pkg-config --cflags --libs fcl) && ./a.out
#include <fcl/fcl.h>
#include <iostream>

int main() {
    // A vertical capsule crosses a horizontal one at a right angle: 3 m above it at the start, 1 m below it at the end.
    fcl::Capsuled capsule(0.5, 2);
    fcl::Transform3d lying = fcl::Transform3d::Identity(), above = lying, below = lying;
    lying.linear() = fcl::AngleAxisd(1.5707963267948966, fcl::Vector3d::UnitY()).toRotationMatrix();
    above.linear() = below.linear() = fcl::AngleAxisd(1.5707963267948966, fcl::Vector3d::UnitX()).toRotationMatrix();
    above.translation().z() = 3;
    below.translation().z() = -1;
    for (auto solver : {fcl::CCDC_NAIVE, fcl::CCDC_CONSERVATIVE_ADVANCEMENT}) {
        fcl::ContinuousCollisionRequestd request(1000, 1e-4, fcl::CCDM_TRANS, fcl::GST_LIBCCD, solver);
        fcl::ContinuousCollisionResultd result;
        fcl::continuousCollide(&capsule, lying, lying, &capsule, above, below, request, result);
        std::cout << (result.is_collide ? "contact" : "no contact") << " at " << result.time_of_contact << '\n';
    }
}
