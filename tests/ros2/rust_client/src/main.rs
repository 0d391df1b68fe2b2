//! A node of ros2-client (Rust) that looks at a world of RoBOSS, drives one of its robots, calls services and an action.
//! Prints what it saw as JSON. Usage: roboss_rust_client ROBOT      the robot has a drive, a lidar and odometry
mod messages;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use futures::FutureExt;
use messages::*;
use ros2_client::action::{ActionClient, ActionClientQosPolicies};
use ros2_client::rcl_interfaces::{GetParametersRequest, GetParametersResponse};
use ros2_client::service::Client;
use ros2_client::{
    ActionTypeName, Context, Message, MessageTypeName, Name, Node, NodeEvent, NodeName, NodeOptions, ParameterValue,
    Publisher, QosProfile, ServiceMapping, ServiceTypeName, Subscription, qos::History,
};
use serde_json::{Value, json};

const PATIENCE: Duration = Duration::from_secs(20);
const PAUSED: u8 = 2;
const PLAYING: u8 = 1;

/// The value of a future, or None where it takes too long; standard error has its name then.
async fn in_time<T>(name: &str, wanted: impl Future<Output = T>) -> Option<T> {
    futures::select! {
        value = Box::pin(wanted.fuse()) => Some(value),
        _ = FutureExt::fuse(smol::Timer::after(PATIENCE)) => {
            eprintln!("rust_visitor: in vain: {name}");
            None
        }
    }
}

/// Waits until two ends have met. In ros2-client 0.12.1 this sometimes does not see that they have: 2 s are enough.
async fn meet(met: impl Future<Output = ()>) {
    futures::select! {
        _ = Box::pin(met.fuse()) => (),
        _ = FutureExt::fuse(smol::Timer::after(Duration::from_secs(2))) => (),
    }
}

fn reliable() -> QosProfile {
    QosProfile::publisher_default().history(History::KeepLast { depth: 10 })
}

struct Visitor {
    context: Context,
    node: Node,
    nodes: Arc<Mutex<BTreeSet<String>>>,
}

impl Visitor {
    fn new() -> Self {
        let context = Context::new().expect("a participant");
        let name = NodeName::new("/", "rust_visitor").expect("a name");
        let mut node = context.new_node(name, NodeOptions::new().enable_rosout(false)).expect("a node");
        smol::spawn(node.spinner().expect("a spinner").spin()).detach();
        let nodes = Arc::new(Mutex::new(BTreeSet::new()));
        let (found, events) = (nodes.clone(), node.status_receiver().expect("events"));
        smol::spawn(async move {
            while let Ok(event) = events.recv().await {
                if let NodeEvent::ParticipantEntities(info) = event {
                    found.lock().unwrap().extend(info.nodes().iter().map(|node| node.fully_qualified_name()));
                }
            }
        })
        .detach();
        Self { context, node, nodes }
    }

    fn topic(&mut self, name: &str, package: &str, kind: &str, qos: &QosProfile) -> ros2_client::dds::rustdds::Topic {
        let name = Name::parse(name).expect("a name");
        self.node.create_topic(&name, MessageTypeName::new(package, kind), qos).expect("a topic")
    }

    fn subscribe<M: Message + 'static>(
        &mut self,
        name: &str,
        package: &str,
        kind: &str,
        qos: QosProfile,
    ) -> Subscription<M> {
        let topic = self.topic(name, package, kind, &qos);
        self.node.create_subscription(&topic, Some(qos)).expect("a subscription")
    }

    fn publish<M: Message>(&mut self, name: &str, package: &str, kind: &str) -> Publisher<M> {
        let topic = self.topic(name, package, kind, &reliable());
        self.node.create_publisher(&topic, Some(reliable())).expect("a publisher")
    }

    /// The reply of a service.
    async fn call<Q, R>(&mut self, name: &str, package: &str, kind: &str, request: Q) -> Option<R>
    where
        Q: Message + Clone + 'static,
        R: Message + Clone + 'static,
    {
        let name = Name::parse(name).expect("a name");
        let client: Client<Q, R> = self
            .node
            .create_client(
                ServiceMapping::Enhanced,
                &name,
                &ServiceTypeName::new(package, kind),
                reliable(),
                reliable(),
            )
            .expect("a client");
        meet(client.wait_for_service(&self.node)).await;
        in_time(&format!("reply of {kind}"), client.async_call_service(request)).await?.ok()
    }

    async fn simulation<Q: Message + Clone + 'static, R: Message + Clone + 'static>(
        &mut self,
        name: &str,
        kind: &str,
        request: Q,
    ) -> Option<R> {
        self.call(name, "simulation_interfaces", kind, request).await
    }

    async fn use_sim_time(&mut self) -> Option<bool> {
        let request = GetParametersRequest { names: vec!["use_sim_time".into()] };
        let reply: GetParametersResponse =
            self.call("/roboss/get_parameters", "rcl_interfaces", "GetParameters", request).await?;
        match ParameterValue::from(reply.values.first()?.clone()) {
            ParameterValue::Boolean(value) => Some(value),
            _ => None,
        }
    }

    /// Pauses the run, gives a goal of the action SimulateSteps and cancels a second one, plays on.
    async fn operate(&mut self) -> Option<Value> {
        let state: StateReply =
            self.simulation("/get_simulation_state", "GetSimulationState", Empty::default()).await?;
        let pause: SetStateReply =
            self.simulation("/set_simulation_state", "SetSimulationState", SetState { state: PAUSED }).await?;
        let qos = reliable();
        let action: ActionClient<Steps, StepsResult, StepsFeedback> = self
            .node
            .create_action_client(
                ServiceMapping::Enhanced,
                &Name::parse("/simulate_steps").expect("a name"),
                &ActionTypeName::new("simulation_interfaces", "SimulateSteps"),
                ActionClientQosPolicies {
                    goal_service: qos.clone(),
                    result_service: qos.clone(),
                    cancel_service: qos.clone(),
                    feedback_subscription: qos.clone(),
                    status_subscription: qos,
                },
            )
            .expect("a client of an action");
        meet(action.goal_client().wait_for_service(&self.node)).await;
        meet(action.result_client().wait_for_service(&self.node)).await;
        meet(action.cancel_client().wait_for_service(&self.node)).await;
        meet(action.feedback_subscription().wait_for_publisher(&self.node)).await;
        let (goal, sent) = in_time("goal", action.async_send_goal(Steps { steps: 500 })).await?.ok()?;
        let (status, result) = in_time("result", action.async_request_result(goal)).await?.ok()?;
        let mut sums = BTreeSet::new();
        while let Ok(Some(step)) = action.receive_feedback(goal) {
            sums.insert(step.completed_steps + step.remaining_steps);
        }
        let (long_goal, long) =
            in_time("second goal", action.async_send_goal(Steps { steps: 1_000_000_000 })).await?.ok()?;
        let stamp = ros2_client::builtin_interfaces::Time::ZERO;
        let cancel = in_time("cancel", action.async_cancel_goal(long_goal, stamp)).await?.ok()?;
        let (cancelled, _) =
            in_time("result of the cancelled goal", action.async_request_result(long_goal)).await?.ok()?;
        let play: SetStateReply =
            self.simulation("/set_simulation_state", "SetSimulationState", SetState { state: PLAYING }).await?;
        Some(json!({
            "state": state.state, "pause": pause.result.result, "play": play.result.result,
            "steps": {"accepted": sent.accepted, "status": status as i8, "result": result.result.result, "sums": sums},
            "cancel": {"accepted": long.accepted, "code": cancel.return_code as i8, "status": cancelled as i8},
        }))
    }
}

/// Messages that arrive until `enough` says so, and no longer than PATIENCE.
async fn listen<M: Message + 'static>(subscription: &Subscription<M>, mut enough: impl FnMut(&M) -> bool) -> Vec<M> {
    let mut seen = Vec::new();
    let end = Instant::now() + PATIENCE;
    while Instant::now() < end {
        let Some(Ok((message, _))) = in_time("message", subscription.async_take()).await else { break };
        let done = enough(&message);
        seen.push(message);
        if done {
            break;
        }
    }
    seen
}

async fn visit(robot: &str) -> Value {
    let mut visitor = Visitor::new();
    let scans: Subscription<LaserScan> =
        visitor.subscribe(&format!("/{robot}/scan"), "sensor_msgs", "LaserScan", QosProfile::subscription_default());
    let odometry: Subscription<Odometry> =
        visitor.subscribe(&format!("/{robot}/odom"), "nav_msgs", "Odometry", reliable());
    let clocks: Subscription<Clock> = visitor.subscribe("/clock", "rosgraph_msgs", "Clock", reliable());
    let drive: Publisher<Twist> = visitor.publish(&format!("/{robot}/cmd_vel"), "geometry_msgs", "Twist");
    let began = Instant::now();
    let scan = listen(&scans, |_| true).await;
    let seconds = began.elapsed().as_secs_f64();
    let start = listen(&odometry, |_| true).await;
    meet(drive.wait_for_subscription(&visitor.node)).await;
    let order = Twist { linear: Vector3 { x: 0.2, ..Default::default() }, ..Default::default() };
    let _ = drive.publish(order);
    let mut fast_since = None;
    let way = listen(&odometry, |seen| {
        if seen.twist.twist.linear.x > 0.15 {
            fast_since.get_or_insert_with(Instant::now);
        }
        fast_since.is_some_and(|since| since.elapsed() > Duration::from_secs(2))
    })
    .await;
    let moved = match (start.first(), way.last()) {
        (Some(from), Some(to)) => {
            let (from, to) = (&from.pose.pose.position, &to.pose.pose.position);
            (to.x - from.x).hypot(to.y - from.y)
        }
        _ => 0.0,
    };
    let mut times = Vec::new();
    listen(&clocks, |seen| {
        times.push(f64::from(seen.clock.sec) + 1e-9 * f64::from(seen.clock.nanosec));
        times.len() == 20
    })
    .await;
    let topics: BTreeMap<String, String> =
        visitor.context.discovered_topics().into_iter().map(|topic| (topic.name, topic.type_name)).collect();
    let use_sim_time = visitor.use_sim_time().await;
    let operated = visitor.operate().await;
    let nodes: Vec<String> = visitor.nodes.lock().unwrap().iter().cloned().collect();
    json!({
        "nodes": nodes, "topics": topics, "seconds": seconds, "moved": moved, "clock": times, "use_sim_time": use_sim_time,
        "ranges": scan.first().map_or(0, |scan| scan.ranges.len()),
        "frame": scan.first().map_or("", |scan| &scan.header.frame_id), "operated": operated,
    })
}

fn main() {
    let robot = std::env::args().nth(1).expect("usage: roboss_rust_client ROBOT");
    println!("{}", smol::block_on(visit(&robot)));
}
