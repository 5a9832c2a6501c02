//! One ball that flies, turns and bounces off the faces of the domain, in Rust:
//!
//!     rustc -O bouncing_ball.rs && broadside run rolling_ball.toml --engine ./bouncing_ball
//!
//! Each face has one point of contact, so the impulses are in closed form: the normal impulse that stops or reverses
//! the approach, and the friction that stops the slip or lies on the cone.
#[path = "../clients/broadside_engine.rs"]
mod broadside_engine;
use broadside_engine::*;

type V = [f64; 3];
fn add(a: V, b: V) -> V {
    std::array::from_fn(|k| a[k] + b[k])
}
fn scaled(s: f64, a: V) -> V {
    a.map(|x| s * x)
}
fn dot(a: V, b: V) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}
fn size(a: V) -> f64 {
    dot(a, a).sqrt()
}
fn cross(a: V, b: V) -> V {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Rounds to the next float32 outward, so that recorded boxes contain the ball.
fn outward(x: f64, side: f64) -> f32 {
    let near = x as f32;
    if side * (near as f64 - x) > 0.0 {
        near
    } else {
        near + side as f32 * (near.abs() * f32::EPSILON).max(f32::MIN_POSITIVE)
    }
}

#[derive(Default)]
struct Ball {
    scene: Scene,
    radius: f64,
    state: State,
    mu: f64,
    slide: f64,
    restitution: f64,
    points: Vec<Point>,
    seen: Vec<Detection>,
}

impl Ball {
    fn moment(&self) -> f64 {
        self.scene.bodies[0].inertia[0]
    }
    /// Inward normal and gap of a face.
    fn face(&self, face: usize) -> (V, f64) {
        let (axis, side) = (face / 2, if face % 2 == 0 { 1.0 } else { -1.0 });
        let wall = if face % 2 == 0 { self.scene.domain_min } else { self.scene.domain_max }[axis];
        (
            std::array::from_fn(|k| if k == axis { side } else { 0.0 }),
            side * (self.state.position[axis] - wall) - self.radius,
        )
    }
    fn approach(&self, n: V) -> f64 {
        -dot(self.state.velocity, n)
    }

    /// Brings the speed along n to at least `least`, and brakes the slip. Returns the impulse.
    fn push(&mut self, n: V, least: f64) -> V {
        let mass = self.scene.bodies[0].mass;
        let normal = (mass * (least + self.approach(n))).max(0.0);
        let arm = scaled(-self.radius, n);
        let v = add(self.state.velocity, cross(self.state.angular_velocity, arm));
        let slip = add(v, scaled(-dot(v, n), n));
        let mut drag = scaled(-1.0 / (1.0 / mass + self.radius * self.radius / self.moment()), slip);
        if size(drag) > self.mu * normal {
            drag = scaled(self.slide * normal / size(drag), drag)
        }
        let impulse = add(scaled(normal, n), drag);
        self.state.velocity = add(self.state.velocity, scaled(1.0 / mass, impulse));
        self.state.angular_velocity =
            add(self.state.angular_velocity, scaled(1.0 / self.moment(), cross(arm, impulse)));
        impulse
    }

    /// Rotates by the rotation vector h w, which is exact: a ball's spin is constant while nothing acts on it.
    fn turn(&mut self, h: f64) {
        let angle = h * size(self.state.angular_velocity);
        let s = if angle > 0.0 { h * (0.5 * angle).sin() / angle } else { 0.5 * h };
        let (c, u) = ((0.5 * angle).cos(), scaled(s, self.state.angular_velocity));
        let [w, x, y, z] = self.state.orientation;
        let v = add(add(scaled(c, [x, y, z]), scaled(w, u)), cross(u, [x, y, z]));
        let q = [c * w - dot(u, [x, y, z]), v[0], v[1], v[2]];
        let norm = q.iter().map(|x| x * x).sum::<f64>().sqrt();
        self.state.orientation = q.map(|x| x / norm);
    }
}

impl Engine for Ball {
    fn hello(&self) -> Hello {
        Hello {
            offers: DYNAMICS | POINTS | DETECTION | STEP_SECONDS,
            is_exact: true,
            margin_m: 0.0,
            id: "example-bouncing-rust",
            build: "example 1.0, double",
            what: "an example in Rust: one ball that bounces",
            settings: Vec::new(),
            declared: vec![
                ("motion", "rigid"),
                ("detection_at", "start"),
                ("contacts", "totals"),
                ("friction", "cone"),
                ("integrator", "semi-implicit Euler"),
                ("correction", "none"),
                ("precision", "f64"),
            ],
        }
    }

    fn begin(&mut self, given: &Scene) -> Done {
        let mut kept = Scene {
            domain_min: given.domain_min,
            domain_max: given.domain_max,
            gravity: given.gravity,
            v_threshold: given.v_threshold,
            ..Default::default()
        };
        kept.bodies = given.bodies.clone();
        let [body] = given.bodies[..] else { return Err("this example simulates one body".into()) };
        let shape = given.shapes[body.mesh as usize];
        if shape.kind != 2 {
            return Err("unsupported shape: this example has spheres".into());
        }
        if body.is_static || !given.turns {
            return Err("this example simulates a body that moves and turns".into());
        }
        if !given.wrenches.is_empty() {
            return Err("unsupported: wrenches".into());
        }
        *self = Ball {
            scene: kept,
            radius: shape.radius,
            state: body.state,
            mu: (body.mu_static * given.face_mu_static).sqrt(),
            slide: (body.mu_kinetic * given.face_mu_kinetic).sqrt(),
            restitution: body.restitution.max(given.face_restitution),
            points: Vec::new(),
            seen: Vec::new(),
        };
        Ok(())
    }

    fn step(&mut self, h: f64) -> Result<f64, String> {
        let start = std::time::Instant::now();
        let s = self.state;
        let aabb = Aabb {
            min: s.position.map(|x| outward(x - self.radius, -1.0)),
            max: s.position.map(|x| outward(x + self.radius, 1.0)),
        };
        self.seen = vec![Detection { position: s.position, orientation: s.orientation, velocity: s.velocity, aabb }];
        self.points.clear();
        let faces: Vec<_> = (0..6).map(|face| self.face(face)).collect();
        let mut total = [[0.0; 3]; 6];
        for (face, &(n, gap)) in faces.iter().enumerate() {
            let speed = self.approach(n);
            if speed > self.scene.v_threshold && gap < h * (speed - h * dot(self.scene.gravity, n)) {
                total[face] = self.push(n, self.restitution * speed);
            }
        }
        let before = self.state.velocity;
        self.state.velocity = add(before, scaled(h, self.scene.gravity));
        let free = self.state.velocity;
        for (face, &(n, gap)) in faces.iter().enumerate() {
            let least = -gap.max(0.0) / h;
            if -self.approach(n) < least {
                total[face] = add(total[face], self.push(n, least))
            }
        }
        // Free flight is exact; a ball that a face stopped moves with the velocity that the face allows.
        let is_free = self.state.velocity == free;
        let way = if is_free { scaled(0.5 * h, add(before, free)) } else { scaled(h, self.state.velocity) };
        for (face, &(normal, gap)) in faces.iter().enumerate() {
            if size(total[face]) > 0.0 || gap <= 0.0 {
                let point = add(self.state.position, scaled(-self.radius, normal));
                self.points.push(Point {
                    a: 0,
                    b: FIRST_FACE + face as u32,
                    point,
                    normal,
                    gap,
                    impulse: total[face],
                    feature: 0,
                });
            }
        }
        self.state.position = add(self.state.position, way);
        self.turn(h);
        Ok(start.elapsed().as_secs_f64())
    }

    fn states(&self) -> Vec<State> {
        vec![self.state]
    }
    fn points(&self) -> Vec<Point> {
        self.points.clone()
    }
    fn detection(&self) -> Vec<Detection> {
        self.seen.clone()
    }
}

fn main() {
    serve(&mut Ball::default());
}
