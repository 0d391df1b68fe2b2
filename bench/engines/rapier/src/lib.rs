//! Rapier behind C functions: bodies, shapes, joints and motors by number. The other side is
//! bench/engines/rapier_engine.cpp; rapier.h declares these functions. Poses are x y z and quaternion x y z w; SI units.
//! A body number of `u32::MAX` is the fixed body of the scenery.
use rapier3d_f64::parry::mass_properties::MassProperties;
use rapier3d_f64::prelude::*;
use std::slice;

/// Shapes of one robot do not touch each other, and belts move what lies on them.
struct Hooks {
    belts: Vec<Vector>, // by collider user data
}

/// What a collider's user data says: robot + 1, and the belt's number + 1 above.
fn robot_of(collider: &Collider) -> u128 {
    collider.user_data & 0xffff_ffff
}

impl PhysicsHooks for Hooks {
    fn filter_contact_pair(&self, context: &PairFilterContext) -> Option<SolverFlags> {
        let (a, b) = (&context.colliders[context.collider1], &context.colliders[context.collider2]);
        (robot_of(a) != robot_of(b)).then_some(SolverFlags::COMPUTE_RIGID_IMPULSES)
    }

    fn modify_solver_contacts(&self, context: &mut ContactModificationContext) {
        let belt_of = |handle: ColliderHandle| (context.colliders[handle].user_data >> 32) as usize;
        let (a, b) = (belt_of(context.collider1), belt_of(context.collider2));
        let moves = |belt: usize| if belt > 0 { self.belts[belt - 1] } else { Vector::ZERO };
        let velocity = moves(a) - moves(b);
        if let Some(manifold) = context.rigid_mut() {
            for contact in manifold.solver_contacts.iter_mut() {
                contact.tangent_velocity = velocity;
            }
        }
    }
}

pub struct Sim {
    world: PhysicsWorld,
    hooks: Hooks,
    hooked: bool,
    scenery: RigidBodyHandle,
    bodies: Vec<RigidBodyHandle>,
    joints: Vec<(ImpulseJointHandle, JointAxis)>,
    sleeps: bool,
}

impl Sim {
    fn body(&self, number: u32) -> RigidBodyHandle {
        if number == u32::MAX { self.scenery } else { self.bodies[number as usize] }
    }
}

unsafe fn vector(v: *const f64) -> Vector {
    let v = slice::from_raw_parts(v, 3);
    Vector::new(v[0], v[1], v[2])
}

unsafe fn pose(x: *const f64) -> Pose {
    let x = slice::from_raw_parts(x, 7);
    Pose::from_parts(Vector::new(x[0], x[1], x[2]), Rotation::from_xyzw(x[3], x[4], x[5], x[6]))
}

#[no_mangle]
pub unsafe extern "C" fn rapier_new(gravity: *const f64, dt: f64, iterations: u32, ccd: bool, sleeps: bool, length_unit: f64) -> *mut Sim {
    let mut world = PhysicsWorld::new();
    world.gravity = vector(gravity);
    let parameters = &mut world.integration_parameters;
    parameters.dt = dt;
    parameters.length_unit = length_unit;
    parameters.normalized_max_linear_velocity = 400.0 / length_unit;
    parameters.num_solver_iterations = iterations as usize;
    parameters.max_ccd_substeps = usize::from(ccd);
    parameters.warmstart_joints = true;
    parameters.friction_model = FrictionModel::Coulomb;
    parameters.soft_bodies = Default::default();
    let scenery = world.bodies.insert(RigidBodyBuilder::fixed());
    let hooks = Hooks { belts: Vec::new() };
    Box::into_raw(Box::new(Sim { world, hooks, hooked: false, scenery, bodies: vec![], joints: vec![], sleeps }))
}

#[no_mangle]
pub unsafe extern "C" fn rapier_free(sim: *mut Sim) {
    drop(Box::from_raw(sim));
}

/// `moments` about the axes `frame` (quaternion x y z w), both at the centre of mass.
#[no_mangle]
pub unsafe extern "C" fn rapier_body(
    sim: *mut Sim, mass: f64, centre: *const f64, moments: *const f64, frame: *const f64, gravity: bool, ccd: bool,
) -> u32 {
    let sim = &mut *sim;
    let frame = slice::from_raw_parts(frame, 4);
    let mass = MassProperties::with_principal_inertia_frame(
        vector(centre), mass, vector(moments), Rotation::from_xyzw(frame[0], frame[1], frame[2], frame[3]));
    let body = RigidBodyBuilder::dynamic()
        .additional_mass_properties(mass)
        .gravity_scale(if gravity { 1.0 } else { 0.0 })
        .gyroscopic_forces_enabled(true)
        .allow_fast_rotation(true)
        .can_sleep(sim.sleeps)
        .ccd_enabled(ccd);
    sim.bodies.push(sim.world.bodies.insert(body));
    sim.bodies.len() as u32 - 1
}

/// Kinds: 0 box (size x y z), 1 sphere (radius), 2 cylinder (radius, length; about z), 3 capsule (the same), 4 plane (z up).
#[no_mangle]
pub unsafe extern "C" fn rapier_shape(
    sim: *mut Sim, body: u32, kind: u32, size: *const f64, at: *const f64, friction: f64, restitution: f64, groups: u32,
    robot: u32, filter: bool, belt: *const f64,
) {
    let sim = &mut *sim;
    let size = slice::from_raw_parts(size, 3);
    // Rapier's cylinders and capsules are about y.
    let about_z = Pose::from_parts(Vector::ZERO, Rotation::from_rotation_x(std::f64::consts::FRAC_PI_2));
    let (shape, turn) = match kind {
        0 => (ColliderBuilder::cuboid(size[0] / 2.0, size[1] / 2.0, size[2] / 2.0), Pose::IDENTITY),
        1 => (ColliderBuilder::ball(size[0]), Pose::IDENTITY),
        2 => (ColliderBuilder::cylinder(size[1] / 2.0, size[0]), about_z),
        3 => (ColliderBuilder::capsule_y(size[1] / 2.0, size[0]), about_z),
        _ => (ColliderBuilder::halfspace(rapier3d_f64::na::Unit::new_unchecked(Vector::Z)), Pose::IDENTITY),
    };
    let belt = vector(belt);
    let moves = belt != Vector::ZERO;
    if moves {
        sim.hooks.belts.push(belt);
    }
    let mut hooks = ActiveHooks::empty();
    hooks.set(ActiveHooks::FILTER_CONTACT_PAIRS, filter);
    hooks.set(ActiveHooks::MODIFY_SOLVER_CONTACTS, moves);
    sim.hooked |= filter || moves;
    let number = if moves { sim.hooks.belts.len() as u128 } else { 0 };
    let groups = Group::from_bits_truncate(groups);
    let shape = shape
        .position(pose(at) * turn)
        .density(0.0)
        .friction(friction)
        .friction_combine_rule(CoefficientCombineRule::Min)
        .restitution(restitution)
        .restitution_combine_rule(CoefficientCombineRule::Max)
        .collision_groups(InteractionGroups::new(groups, groups, InteractionTestMode::And))
        .active_hooks(hooks)
        .user_data(u128::from(robot) + 1 + (number << 32));
    let parent = sim.body(body);
    sim.world.colliders.insert_with_parent(shape, parent, &mut sim.world.bodies);
}

/// Kinds: 0 hinge, 1 slide (about and along the frames' x axis), 2 ball, 3 fixed. A limit of infinity is none.
#[no_mangle]
pub unsafe extern "C" fn rapier_joint(
    sim: *mut Sim, kind: u32, body1: u32, body2: u32, frame1: *const f64, frame2: *const f64, lower: f64, upper: f64,
) -> u32 {
    let sim = &mut *sim;
    let (locked, axis) = match kind {
        0 => (JointAxesMask::LOCKED_REVOLUTE_AXES, JointAxis::AngX),
        1 => (JointAxesMask::LOCKED_PRISMATIC_AXES, JointAxis::LinX),
        2 => (JointAxesMask::LOCKED_SPHERICAL_AXES, JointAxis::AngX),
        _ => (JointAxesMask::LOCKED_FIXED_AXES, JointAxis::AngX),
    };
    let mut joint = GenericJoint::new(locked);
    joint.set_local_frame1(pose(frame1)).set_local_frame2(pose(frame2)).set_contacts_enabled(false);
    if lower.is_finite() || upper.is_finite() {
        joint.set_limits(axis, [lower.max(-1e9), upper.min(1e9)]);
    }
    let (a, b) = (sim.body(body1), sim.body(body2));
    sim.joints.push((sim.world.impulse_joints.insert(a, b, joint, true), axis));
    sim.joints.len() as u32 - 1
}

/// effort = clamp(stiffness (position - q) + damping (velocity - qd), +- most)
#[no_mangle]
pub unsafe extern "C" fn rapier_motor(
    sim: *mut Sim, joint: u32, position: f64, velocity: f64, stiffness: f64, damping: f64, most: f64,
) {
    let sim = &mut *sim;
    let (handle, axis) = sim.joints[joint as usize];
    if let Some(joint) = sim.world.impulse_joints.get_mut(handle, true) {
        joint.data.set_motor_model(axis, MotorModel::ForceBased);
        joint.data.set_motor(axis, position, velocity, stiffness, damping);
        joint.data.set_motor_max_force(axis, most);
    }
}

/// Pose (7), angular velocity (3), velocity of the centre of mass (3).
#[no_mangle]
pub unsafe extern "C" fn rapier_state(sim: *const Sim, body: u32, out: *mut f64) {
    let sim = &*sim;
    let body = &sim.world.bodies[sim.body(body)];
    let (p, q, w, v) = (body.position().translation, body.position().rotation, body.angvel(), body.linvel());
    slice::from_raw_parts_mut(out, 13)
        .copy_from_slice(&[p.x, p.y, p.z, q.x, q.y, q.z, q.w, w.x, w.y, w.z, v.x, v.y, v.z]);
}

#[no_mangle]
pub unsafe extern "C" fn rapier_set_state(sim: *mut Sim, body: u32, state: *const f64) {
    let sim = &mut *sim;
    let handle = sim.body(body);
    if let Some(body) = sim.world.bodies.get_mut(handle) {
        body.set_position(pose(state), true);
        body.set_angvel(vector(state.add(7)), true);
        body.set_linvel(vector(state.add(10)), true);
    }
}

/// Impulses at the centre of mass.
#[no_mangle]
pub unsafe extern "C" fn rapier_push(sim: *mut Sim, body: u32, impulse: *const f64, turn: *const f64) {
    let sim = &mut *sim;
    let handle = sim.body(body);
    if let Some(body) = sim.world.bodies.get_mut(handle) {
        body.apply_impulse(vector(impulse), true);
        body.apply_torque_impulse(vector(turn), true);
    }
}

#[no_mangle]
pub unsafe extern "C" fn rapier_step(sim: *mut Sim) {
    let sim = &mut *sim;
    if sim.hooked {
        sim.world.step_with_events(&sim.hooks, &());
    } else {
        sim.world.step();
    }
}
