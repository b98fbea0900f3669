// Lets Bullet integrate bodies that fall in samara's water: a single one, beside samara's own flight of it,
// and two on a hinge, one lighter than water.
//
//   c++ bullet_fall.cpp $(pkg-config --cflags --libs samara bullet) -o bullet-fall
//   ./bullet-fall ellipsoid.body.h5
//
// Bullet 3.24. A rigid body of Bullet has a mass and a 3x3 inertia, and no room for the fluid's 6x6. So the
// motion without joints is solved here, with all of the added inertia, and Bullet, which is given the nearest
// mass and inertia that it can hold, finds the impulses of joints and contacts.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include <btBulletDynamicsCommon.h>

#include "water.h"

namespace {

using Six = std::array<double, 6>;  // angular, then linear; world axes, at the centre of mass

btVector3 vector_of(const double* numbers) {
    return {btScalar(numbers[0]), btScalar(numbers[1]), btScalar(numbers[2])};
}

struct Link {
    std::unique_ptr<btCollisionShape> shape;
    std::unique_ptr<btRigidBody> rigid;  // its frame: the centre of mass, with the shape's axes
    samara_mass_properties own;
    Six by_joints{};  // by how much joints changed its velocity in the last step
};

struct Host {
    samara_simulation* fluid;
    double step;
    int steps = 0;
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
    std::vector<Link> links;
    std::unique_ptr<btHingeConstraint> hinge;
};

// ---- The coupling --------------------------------------------------------------------------------------

Six velocity_of(const btRigidBody& body) {
    const btVector3& angular = body.getAngularVelocity();
    const btVector3& linear = body.getLinearVelocity();
    return {angular.x(), angular.y(), angular.z(), linear.x(), linear.y(), linear.z()};
}

samara_pose pose_of(const Link& link) {
    samara_pose pose;
    const btTransform& place = link.rigid->getWorldTransform();
    const btVector3 origin = place * -vector_of(link.own.center_of_mass);
    const btQuaternion turn = place.getRotation();
    const Six velocity = velocity_of(*link.rigid);
    for (int i = 0; i < 3; ++i) pose.position[i] = origin[i];
    const double orientation[] = {turn.w(), turn.x(), turn.y(), turn.z()};
    std::memcpy(pose.orientation, orientation, sizeof orientation);
    std::memcpy(pose.angular_velocity, velocity.data(), sizeof pose.angular_velocity);
    std::memcpy(pose.velocity, velocity.data() + 3, sizeof pose.velocity);
    return pose;
}

// The x of matrix x = right, for a matrix of inertia and damping, which needs no pivots.
Six solved(std::array<Six, 6> matrix, Six right) {
    for (std::size_t column = 0; column < 6; ++column) {
        for (std::size_t row = column + 1; row < 6; ++row) {
            const double share = matrix[row][column] / matrix[column][column];
            for (std::size_t k = column; k < 6; ++k) matrix[row][k] -= share * matrix[column][k];
            right[row] -= share * right[column];
        }
    }
    for (std::size_t row = 6; row-- > 0;) {
        for (std::size_t k = row + 1; k < 6; ++k) right[row] -= matrix[row][k] * right[k];
        right[row] /= matrix[row][row];
    }
    return right;
}

// The least of the masses that M + A has along the axes, and its moments of inertia about those of the body:
// Bullet takes no more.
void set_inertia(btRigidBody& body, const std::array<Six, 6>& whole) {
    const btMatrix3x3& turn = body.getWorldTransform().getBasis();
    btMatrix3x3 angular;
    double least = whole[3][3];
    for (int i = 0; i < 3; ++i) {
        const auto row = static_cast<std::size_t>(i);
        angular[i] = vector_of(whole[row].data());
        least = std::min(least, whole[3 + row][3 + row]);
    }
    angular = turn.transpose() * angular * turn;
    body.setMassProps(btScalar(least), {angular[0][0], angular[1][1], angular[2][2]});
    body.updateInertiaTensor();
}

// Bullet's mass and inertia times a change of velocity.
Six momentum_of(const btRigidBody& body, const Six& change) {
    const btVector3 moment = body.getInvInertiaTensorWorld().inverse() * vector_of(change.data());
    Six result{};
    for (int i = 0; i < 3; ++i) {
        const auto row = static_cast<std::size_t>(i);
        result[row] = moment[i];
        result[3 + row] = change[3 + row] * body.getMass();
    }
    return result;
}

// Gives a body the velocity that it would have at the step's end, if joints went on as in the last step:
// (M + A + h D) dv = h (weight, gyroscopic moment and wrench) + the joints' impulse. That impulse Bullet
// finds anew, so what it changes there is taken off again.
void sample_fluid(Host& host, std::size_t number) {
    Link& link = host.links[number];
    btRigidBody& body = *link.rigid;
    const samara_pose pose = pose_of(link);
    samara_fluid_load load;
    check(samara_set_poses(host.fluid, number, 1, &pose, 0, error, sizeof error));
    check(samara_get_fluid_load(host.fluid, number, &load, error, sizeof error));

    const btMatrix3x3& turn = body.getWorldTransform().getBasis();
    const double* j = link.own.inertia;
    const btMatrix3x3 inertia =
        turn *
        btMatrix3x3(btScalar(j[0]), btScalar(j[1]), btScalar(j[2]), btScalar(j[3]), btScalar(j[4]),
                    btScalar(j[5]), btScalar(j[6]), btScalar(j[7]), btScalar(j[8])) *
        turn.transpose();
    std::array<Six, 6> whole{};
    for (std::size_t row = 0; row < 6; ++row) {
        std::memcpy(whole[row].data(), load.added_inertia + 6 * row, sizeof whole[row]);
        if (row >= 3) whole[row][row] += link.own.mass;
        for (std::size_t k = 0; k < 3 && row < 3; ++k) whole[row][k] += inertia[int(row)][int(k)];
    }
    set_inertia(body, whole);

    const btVector3 angular = body.getAngularVelocity();
    const btVector3 gyroscopic = angular.cross(inertia * angular);
    Six impulse = momentum_of(body, link.by_joints);
    for (std::size_t row = 0; row < 6; ++row) {
        impulse[row] += host.step * (load.wrench[row] - (row < 3 ? gyroscopic[int(row)] : 0.0));
        for (std::size_t k = 0; k < 6; ++k) whole[row][k] += host.step * load.damping[6 * row + k];
    }
    impulse[5] -= host.step * link.own.mass * 9.81;
    const Six change = solved(whole, impulse);
    Six velocity = velocity_of(body);
    for (std::size_t row = 0; row < 6; ++row) velocity[row] += change[row] - link.by_joints[row];
    body.setAngularVelocity(vector_of(velocity.data()));
    body.setLinearVelocity(vector_of(velocity.data() + 3));
}

void step_host(Host& host) {
    for (std::size_t i = 0; i < host.links.size(); ++i) sample_fluid(host, i);
    std::vector<Six> before;
    for (const Link& link : host.links) before.push_back(velocity_of(*link.rigid));
    host.world.stepSimulation(btScalar(host.step), 0);
    for (std::size_t i = 0; i < host.links.size(); ++i) {
        const Six after = velocity_of(*host.links[i].rigid);
        for (std::size_t row = 0; row < 6; ++row) host.links[i].by_joints[row] = after[row] - before[i][row];
    }
    // Turbulence and wind go on; where samara took the bodies meanwhile is of no account.
    check(samara_advance_to(host.fluid, ++host.steps * host.step, error, sizeof error));
}

// ---- What falls ----------------------------------------------------------------------------------------

// Links above each other; the second on a hinge along x, halfway between their origins.
std::unique_ptr<Host> make_host(const samara_body* body, double step, int turbulent,
                                const std::vector<double>& densities, double gap) {
    auto host = std::make_unique<Host>();
    host->step = step;
    host->fluid = water(body, step, turbulent, densities.data(), int(densities.size()));
    host->world.setGravity({0, 0, 0});
    samara_pose start;
    check(samara_get_poses(host->fluid, 0, 1, &start, 0, error, sizeof error));
    const btVector3 axis = vector_of(start.orientation + 1);
    const btQuaternion turn(axis.x(), axis.y(), axis.z(), btScalar(start.orientation[0]));
    const btTransform place(turn, vector_of(start.position));
    for (std::size_t i = 0; i < densities.size(); ++i) {
        Link& link = host->links.emplace_back();
        check(samara_get_mass_properties(host->fluid, i, &link.own, error, sizeof error));
        link.shape = std::make_unique<btEmptyShape>();
        link.rigid = std::make_unique<btRigidBody>(btScalar(link.own.mass), nullptr, link.shape.get());
        const btVector3 above(0, 0, btScalar(gap * double(i)));
        const btVector3 center = place * (above + vector_of(link.own.center_of_mass));
        link.rigid->setWorldTransform(btTransform(turn, center));
        link.rigid->setActivationState(DISABLE_DEACTIVATION);
        link.rigid->setFlags(0);  // its gyroscopic moment is in sample_fluid()
        host->world.addRigidBody(link.rigid.get());
    }
    if (host->links.size() > 1) {
        const btVector3 half(0, 0, btScalar(0.5 * gap));
        const Link& low = host->links[0];
        const Link& high = host->links[1];
        host->hinge = std::make_unique<btHingeConstraint>(
            *low.rigid, *high.rigid, half - vector_of(low.own.center_of_mass),
            -half - vector_of(high.own.center_of_mass), btVector3(1, 0, 0), btVector3(1, 0, 0));
        host->world.addConstraint(host->hinge.get(), true);
    }
    return host;
}

void free_host(std::unique_ptr<Host> host) {
    if (host->hinge) host->world.removeConstraint(host->hinge.get());
    for (const Link& link : host->links) host->world.removeRigidBody(link.rigid.get());
    samara_simulation_free(host->fluid);
}

double difference(const samara_body* body, double step) {
    std::unique_ptr<Host> host = make_host(body, step, 0, {1200.0}, 0.0);
    const int steps = static_cast<int>(std::lround(1.0 / step));
    for (int i = 0; i < steps; ++i) step_host(*host);
    const samara_pose pose = pose_of(host->links[0]);
    free_host(std::move(host));
    return off_from_own_flight(body, step, 1200.0, steps * step, pose.position);
}

}  // namespace

int main(int count, char** words) {
    if (count != 2) {
        std::fprintf(stderr, "Usage: bullet-fall NAME.body.h5\n");
        return 1;
    }
    samara_body* body;
    check(samara_body_load(words[1], &body, error, sizeof error));

    std::printf("A single body after 1 s, Bullet beside samara:\n");
    for (const double step : {0.004, 0.002, 0.001, 0.0005}) {
        std::printf("  step %6.4f s  off by %7.4f %%\n", step, 100.0 * difference(body, step));
    }

    std::printf("Two on a hinge, 1500 and 900 kg/m^3, with turbulence:\n");
    std::unique_ptr<Host> pair = make_host(body, 0.002, 1, {1500.0, 900.0}, 0.1);
    for (int i = 1; i <= 2500; ++i) {
        step_host(*pair);
        if (i % 500 != 0) continue;
        const samara_pose low = pose_of(pair->links[0]), high = pose_of(pair->links[1]);
        const btTransform one = pair->links[0].rigid->getWorldTransform() * pair->hinge->getAFrame();
        const btTransform two = pair->links[1].rigid->getWorldTransform() * pair->hinge->getBFrame();
        std::printf("  %3.1f s  heights %7.3f %7.3f m  hinge %7.1f degrees, open by %6.4f mm\n",
                    pair->steps * pair->step, low.position[2], high.position[2],
                    pair->hinge->getHingeAngle() * 57.29578,
                    (one.getOrigin() - two.getOrigin()).length() * 1000.0);
    }
    free_host(std::move(pair));
    samara_body_free(body);
    return 0;
}
