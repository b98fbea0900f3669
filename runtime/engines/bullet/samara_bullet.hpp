/* Samara's fluid around rigid bodies of Bullet: docs/how-to/other-engines.md. C++17; link samara and Bullet.
 *
 *     samara::BulletFluid fluid(world, simulation, 0.002);   // samara.h: a group for each body, without
 * ground fluid.add(rigid_body, 0);                              // and what number it has in the simulation
 *     for (;;) fluid.step();                                 // in place of world.stepSimulation()
 *
 * A rigid body of Bullet has a mass and a 3x3 inertia, and no room for the fluid's 6x6. So the motion without
 * joints and contacts is solved here, with all of the added inertia, and Bullet, which is given the nearest
 * mass and inertia that it can hold, finds their impulses.
 */
#ifndef SAMARA_BULLET_HPP
#define SAMARA_BULLET_HPP

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include <btBulletDynamicsCommon.h>
#include <samara.h>

namespace samara {

/// Couples rigid bodies of a Bullet world to the bodies of a simulation.
class BulletFluid {
  public:
    /// Takes a world and a simulation, which must outlive this, and the step (s) that the simulation was made
    /// with. Weights are by the world's gravity, which should be the simulation's.
    BulletFluid(btDiscreteDynamicsWorld& world, samara_simulation* simulation, double step)
        : world_(world), simulation_(simulation), step_(step) {}

    /// Couples a rigid body to the simulation's body of that number. Its frame must be the centre of mass
    /// with the axes of the shape. Its mass, inertia, gravity and gyroscopic moment are from now on samara's,
    /// and it does not fall asleep: Bullet would stop what sinks slowly. Throws std::runtime_error for a
    /// number without a body.
    void add(btRigidBody& body, std::size_t number) {
        Member member{&body, number, {}, {}, {}, 0.0};
        check(samara_get_mass_properties(simulation_, number, &member.own, error_.data(), error_.size()));
        body.setFlags(BT_DISABLE_WORLD_GRAVITY);
        body.setGravity({0, 0, 0});
        body.setActivationState(DISABLE_DEACTIVATION);
        members_.push_back(member);
    }

    /// Ends the coupling of a rigid body.
    void remove(const btRigidBody& body) {
        members_.erase(std::remove_if(members_.begin(), members_.end(),
                                      [&](const Member& member) { return member.body == &body; }),
                       members_.end());
    }

    /// Steps the world, and the fluid with it, by the step. Throws std::runtime_error where samara rejects a
    /// motion.
    void step() {
        before_step();
        world_.stepSimulation(btScalar(step_), 0);
        after_step();
    }

    /// The part of step() before the world's own, for those who step it themselves: gives each body its
    /// velocity at the step's end, as if joints and contacts went on as in the last step.
    void before_step() {
        for (Member& member : members_) move(member);
    }

    /// The part of step() after the world's own: notes what joints and contacts did, and lets turbulence and
    /// wind go on.
    void after_step() {
        for (Member& member : members_) note_impulse(member);
        // Where samara took the bodies meanwhile is of no account.
        const double steps = std::round(samara_simulation_time(simulation_) / step_) + 1.0;
        check(samara_advance_to(simulation_, steps * step_, error_.data(), error_.size()));
    }

    /// Returns the pose, in samara's terms, of the body that was added first, second, ...
    samara_pose pose(std::size_t index) const { return pose_of(members_.at(index)); }

  private:
    using Six = std::array<double, 6>;  // angular, then linear; world axes, at the centre of mass
    using Matrix = std::array<Six, 6>;

    struct Member {
        btRigidBody* body;
        std::size_t number;
        samara_mass_properties own;
        Six before;     // the velocity that Bullet was given
        Six impulse;    // of joints and contacts in the last step
        double steady;  // impulse of the other forces in a step, N s
    };

    void check(samara_status status) const {
        if (status != SAMARA_OK) throw std::runtime_error(error_.data());
    }

    static btVector3 vector_of(const double* numbers) {
        return {btScalar(numbers[0]), btScalar(numbers[1]), btScalar(numbers[2])};
    }

    static Six joined(const btVector3& angular, const btVector3& linear) {
        return {angular.x(), angular.y(), angular.z(), linear.x(), linear.y(), linear.z()};
    }

    static Six velocity_of(const btRigidBody& body) {
        return joined(body.getAngularVelocity(), body.getLinearVelocity());
    }

    static samara_pose pose_of(const Member& member) {
        samara_pose pose;
        const btTransform& place = member.body->getWorldTransform();
        const btVector3 origin = place * -vector_of(member.own.center_of_mass);
        const btQuaternion turn = place.getRotation();
        const Six velocity = velocity_of(*member.body);
        const double orientation[] = {turn.w(), turn.x(), turn.y(), turn.z()};
        std::copy_n(orientation, 4, pose.orientation);
        std::copy_n(velocity.data(), 3, pose.angular_velocity);
        std::copy_n(velocity.data() + 3, 3, pose.velocity);
        for (int i = 0; i < 3; ++i) pose.position[i] = origin[i];
        return pose;
    }

    // The x of matrix x = right, for a matrix of inertia and damping, which needs no pivots.
    static Six solved(Matrix matrix, Six right) {
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

    // The impulse (angular, linear) that contacts gave a body in the last step.
    Six contact_impulse(const btRigidBody& body) const {
        btVector3 angular(0, 0, 0), linear(0, 0, 0);
        btDispatcher& dispatcher = *world_.getDispatcher();
        for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
            const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
            const bool is_first = manifold.getBody0() == &body;
            if (!is_first && manifold.getBody1() != &body) continue;
            for (int k = 0; k < manifold.getNumContacts(); ++k) {
                const btManifoldPoint& point = manifold.getContactPoint(k);
                const btVector3 impulse = point.m_appliedImpulse * point.m_normalWorldOnB +
                                          point.m_appliedImpulseLateral1 * point.m_lateralFrictionDir1 +
                                          point.m_appliedImpulseLateral2 * point.m_lateralFrictionDir2;
                const btVector3& place = is_first ? point.getPositionWorldOnA() : point.getPositionWorldOnB();
                const btScalar sign = is_first ? 1 : -1;
                linear += sign * impulse;
                angular += (place - body.getCenterOfMassPosition()).cross(sign * impulse);
            }
        }
        return joined(angular, linear);
    }

    // Gives Bullet the least mass that M + A has along the axes, so that what joints and contacts do
    // converges, and its moments of inertia about the body's axes: Bullet takes no more.
    static void set_inertia(btRigidBody& body, const Matrix& whole) {
        const btMatrix3x3& turn = body.getWorldTransform().getBasis();
        btMatrix3x3 angular;
        for (int i = 0; i < 3; ++i) angular[i] = vector_of(whole[static_cast<std::size_t>(i)].data());
        angular = turn.transpose() * angular * turn;
        body.setMassProps(btScalar(std::min({whole[3][3], whole[4][4], whole[5][5]})),
                          {angular[0][0], angular[1][1], angular[2][2]});
        body.updateInertiaTensor();
    }

    // (M + A + h D) dv = h (weight, gyroscopic moment and wrench) + the impulse of joints and contacts. That
    // Bullet finds anew, so what it will change there is taken off again.
    void move(Member& member) {
        btRigidBody& body = *member.body;
        const samara_pose pose = pose_of(member);
        samara_fluid_load load;
        check(samara_set_poses(simulation_, member.number, 1, &pose, 0, error_.data(), error_.size()));
        check(samara_get_fluid_load(simulation_, member.number, &load, error_.data(), error_.size()));

        const btMatrix3x3& turn = body.getWorldTransform().getBasis();
        const double* j = member.own.inertia;
        btMatrix3x3 inertia;
        for (int row = 0; row < 3; ++row) inertia[row] = vector_of(j + std::ptrdiff_t{3} * row);
        inertia = turn * inertia * turn.transpose();
        Matrix whole{};
        for (std::size_t row = 0; row < 6; ++row) {
            std::copy_n(load.added_inertia + 6 * row, 6, whole[row].begin());
            if (row >= 3) whole[row][row] += member.own.mass;
            for (std::size_t k = 0; k < 3 && row < 3; ++k) whole[row][k] += inertia[int(row)][int(k)];
        }
        set_inertia(body, whole);

        const btVector3 angular = body.getAngularVelocity();
        const Six own =
            joined(-angular.cross(inertia * angular), btScalar(member.own.mass) * world_.getGravity());
        Six impulse = member.impulse;
        for (std::size_t row = 0; row < 6; ++row) {
            impulse[row] += step_ * (load.wrench[row] + own[row]);
            for (std::size_t k = 0; k < 6; ++k) whole[row][k] += step_ * load.damping[6 * row + k];
        }
        const Six change = solved(whole, impulse);
        member.steady = step_ * (vector_of(load.wrench + 3) + vector_of(own.data() + 3)).length();
        const btVector3 spin = body.getInvInertiaTensorWorld() * vector_of(member.impulse.data());
        body.setAngularVelocity(angular + vector_of(change.data()) - spin);
        body.setLinearVelocity(body.getLinearVelocity() + vector_of(change.data() + 3) -
                               body.getInvMass() * vector_of(member.impulse.data() + 3));
        member.before = velocity_of(body);
    }

    // What Bullet added by its mass and inertia. The impulse of a hit, more than twice that of the steady
    // forces, does not go on.
    void note_impulse(Member& member) const {
        const btRigidBody& body = *member.body;
        const btVector3 spin = body.getAngularVelocity() - vector_of(member.before.data());
        const btVector3 speed = body.getLinearVelocity() - vector_of(member.before.data() + 3);
        member.impulse = joined(body.getInvInertiaTensorWorld().inverse() * spin, body.getMass() * speed);
        const Six by_contacts = contact_impulse(body);
        if (vector_of(by_contacts.data() + 3).length() < 2 * member.steady) return;
        for (std::size_t row = 0; row < 6; ++row) member.impulse[row] -= by_contacts[row];
    }

    btDiscreteDynamicsWorld& world_;
    samara_simulation* simulation_;
    double step_;
    std::vector<Member> members_;
    mutable std::array<char, 512> error_{};
};

}  // namespace samara

#endif
