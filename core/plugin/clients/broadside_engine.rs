//! An engine for Broadside in Rust: implement `Engine` and call `serve`, which speaks the protocol of
//! core/plugin/PROGRAMS.md over standard input and output, until its input ends. No crates are needed:
//!
//! ```text
//! #[path = "broadside_engine.rs"]
//! mod broadside_engine;
//! ```
//!
//! Broad phases and dynamics are here; names and units are those of broadside_engine_v2.h. An `Err` fails the call with
//! its text. Print for people with `eprintln!`: standard output carries only the protocol.
#![allow(dead_code)]

use std::io::{Read, Write};

pub const FIRST_FACE: u32 = 0xFFFF_FFF0;
pub type Done = Result<(), String>;

/// What the engine declares about itself. `offers` is a sum of the constants below.
pub struct Hello {
    pub offers: u32,
    pub is_exact: bool,
    pub margin_m: f64,
    pub id: &'static str,
    pub build: &'static str,
    pub what: &'static str,
    pub settings: Vec<(&'static str, u64, &'static str)>,
    pub declared: Vec<(&'static str, &'static str)>,
}
pub const BROAD_PHASE: u32 = 1;
pub const DYNAMICS: u32 = 4;
pub const POINTS: u32 = 8;
pub const DETECTION: u32 = 32;
pub const STEP_PAIRS: u32 = 64;
pub const STEP_SECONDS: u32 = 128;

#[derive(Clone, Copy, Default)]
pub struct Aabb {
    pub min: [f32; 3],
    pub max: [f32; 3],
}
#[derive(Clone, Copy, Default)]
pub struct State {
    pub position: [f64; 3],
    pub orientation: [f64; 4],
    pub velocity: [f64; 3],
    pub angular_velocity: [f64; 3],
}
#[derive(Clone, Copy, Default)]
pub struct Point {
    pub a: u32,
    pub b: u32,
    pub point: [f64; 3],
    pub normal: [f64; 3],
    pub gap: f64,
    pub impulse: [f64; 3],
    pub feature: u32,
}
#[derive(Clone, Copy, Default)]
pub struct Detection {
    pub position: [f64; 3],
    pub orientation: [f64; 4],
    pub velocity: [f64; 3],
    pub aabb: Aabb,
}
/// kind: 1 box, 2 sphere, 3 capsule, 4 cylinder, 5 convex, 6 mesh.
#[derive(Clone, Copy, Default)]
pub struct Shape {
    pub kind: u32,
    pub axis: u32,
    pub half_extents: [f64; 3],
    pub radius: f64,
    pub half_length: f64,
}
#[derive(Clone, Copy, Default)]
pub struct Body {
    pub mesh: u32,
    pub is_static: bool,
    pub state: State,
    pub mass: f64,
    pub center_of_mass: [f64; 3],
    pub inertia: [f64; 6],
    pub mu_static: f64,
    pub mu_kinetic: f64,
    pub restitution: f64,
}
#[derive(Clone, Copy, Default)]
pub struct Wrench {
    pub body: u32,
    pub axes: u32,
    pub force: [f64; 3],
    pub torque: [f64; 3],
}
#[derive(Default)]
pub struct Mesh {
    pub vertices: Vec<[f32; 3]>,
    pub triangles: Vec<[u32; 3]>,
}
#[derive(Default)]
pub struct Scene {
    pub name: String,
    pub turns: bool,
    pub frames: u32,
    pub seed: u64,
    pub dt: f64,
    pub gravity: [f64; 3],
    pub domain_min: [f64; 3],
    pub domain_max: [f64; 3],
    pub face_mu_static: f64,
    pub face_mu_kinetic: f64,
    pub face_restitution: f64,
    pub delta: f64,
    pub v_threshold: f64,
    pub v_max: f64,
    pub theta: f64,
    pub shapes: Vec<Shape>,
    pub bodies: Vec<Body>,
    pub wrenches: Vec<Wrench>,
    pub meshes: Vec<Mesh>,
}

/// Implement the groups that `hello` offers.
pub trait Engine {
    fn hello(&self) -> Hello;
    fn create(&mut self, _values: &[u64]) -> Done {
        Ok(())
    }
    fn load_boxes(&mut self, _boxes: &[Aabb], _is_static: &[bool]) -> Done {
        absent()
    }
    fn update_boxes(&mut self, _boxes: &[Aabb]) -> Done {
        absent()
    }
    fn find_pairs(&mut self) -> Done {
        absent()
    }
    fn pairs(&self) -> Vec<[u32; 2]> {
        Vec::new()
    }
    fn begin(&mut self, _scene: &Scene) -> Done {
        absent()
    }
    /// Returns its own seconds, which are sent when STEP_SECONDS is offered.
    fn step(&mut self, _dt: f64) -> Result<f64, String> {
        Err("not offered".into())
    }
    fn states(&self) -> Vec<State> {
        Vec::new()
    }
    fn points(&self) -> Vec<Point> {
        Vec::new()
    }
    fn detection(&self) -> Vec<Detection> {
        Vec::new()
    }
    fn step_pairs(&self) -> Vec<[u32; 2]> {
        Vec::new()
    }
    fn end(&mut self) {}
}
fn absent() -> Done {
    Err("not offered".into())
}

/// Reads numbers from the front of a message.
struct Reader<'a>(&'a [u8]);
impl Reader<'_> {
    fn bytes<const N: usize>(&mut self) -> [u8; N] {
        let (front, rest) = self.0.split_at(N);
        self.0 = rest;
        front.try_into().unwrap()
    }
    fn u32(&mut self) -> u32 {
        u32::from_le_bytes(self.bytes())
    }
    fn u64(&mut self) -> u64 {
        u64::from_le_bytes(self.bytes())
    }
    fn f32(&mut self) -> f32 {
        f32::from_le_bytes(self.bytes())
    }
    fn f64(&mut self) -> f64 {
        f64::from_le_bytes(self.bytes())
    }
    fn f64s<const N: usize>(&mut self) -> [f64; N] {
        std::array::from_fn(|_| self.f64())
    }
    fn aabb(&mut self) -> Aabb {
        Aabb { min: std::array::from_fn(|_| self.f32()), max: std::array::from_fn(|_| self.f32()) }
    }
    fn state(&mut self) -> State {
        State {
            position: self.f64s(),
            orientation: self.f64s(),
            velocity: self.f64s(),
            angular_velocity: self.f64s(),
        }
    }
    fn body(&mut self) -> Body {
        Body {
            mesh: self.u32(),
            is_static: self.u32() != 0,
            state: self.state(),
            mass: self.f64(),
            center_of_mass: self.f64s(),
            inertia: self.f64s(),
            mu_static: self.f64(),
            mu_kinetic: self.f64(),
            restitution: self.f64(),
        }
    }
    fn mesh(&mut self) -> Mesh {
        let (vertices, triangles) = (self.u64(), self.u64());
        Mesh {
            vertices: (0..vertices).map(|_| std::array::from_fn(|_| self.f32())).collect(),
            triangles: (0..triangles).map(|_| std::array::from_fn(|_| self.u32())).collect(),
        }
    }
    fn scene(&mut self) -> Scene {
        let size = self.u32() as usize;
        let name = String::from_utf8_lossy(&self.0[..size]).into_owned();
        self.0 = &self.0[size..];
        let mut scene = Scene {
            name,
            turns: self.u32() == 1,
            frames: self.u32(),
            seed: self.u64(),
            dt: self.f64(),
            gravity: self.f64s(),
            domain_min: self.f64s(),
            domain_max: self.f64s(),
            face_mu_static: self.f64(),
            face_mu_kinetic: self.f64(),
            face_restitution: self.f64(),
            delta: self.f64(),
            v_threshold: self.f64(),
            v_max: self.f64(),
            theta: self.f64(),
            ..Default::default()
        };
        let (meshes, bodies, wrenches) = (self.u32(), self.u32(), self.u32());
        scene.shapes = (0..meshes)
            .map(|_| Shape {
                kind: self.u32(),
                axis: self.u32(),
                half_extents: self.f64s(),
                radius: self.f64(),
                half_length: self.f64(),
            })
            .collect();
        scene.bodies = (0..bodies).map(|_| self.body()).collect();
        scene.wrenches = (0..wrenches)
            .map(|_| Wrench { body: self.u32(), axes: self.u32(), force: self.f64s(), torque: self.f64s() })
            .collect();
        scene.meshes = (0..meshes).map(|_| self.mesh()).collect();
        scene
    }
}

/// Appends little-endian numbers.
#[derive(Default)]
struct Writer(Vec<u8>);
impl Writer {
    fn u32(&mut self, x: u32) {
        self.0.extend(x.to_le_bytes())
    }
    fn u64(&mut self, x: u64) {
        self.0.extend(x.to_le_bytes())
    }
    fn f64s(&mut self, values: &[f64]) {
        values.iter().for_each(|x| self.0.extend(x.to_le_bytes()))
    }
    fn text(&mut self, text: &str) {
        self.u32(text.len() as u32);
        self.0.extend(text.as_bytes());
    }
    /// Cuts the rows to the requested room; the caller then calls again with more room.
    fn rows<T>(&mut self, rows: &[T], room: u64, put: impl Fn(&mut Writer, &T)) {
        self.u64(rows.len() as u64);
        rows.iter().take(room as usize).for_each(|row| put(self, row));
    }
}

fn put_pair(w: &mut Writer, p: &[u32; 2]) {
    p.iter().for_each(|x| w.u32(*x))
}
fn put_state(w: &mut Writer, s: &State) {
    for part in [&s.position[..], &s.orientation, &s.velocity, &s.angular_velocity] {
        w.f64s(part)
    }
}
fn put_point(w: &mut Writer, p: &Point) {
    w.u32(p.a);
    w.u32(p.b);
    for part in [&p.point[..], &p.normal, &[p.gap], &p.impulse] {
        w.f64s(part)
    }
    w.u32(p.feature);
    w.u32(0);
}
fn put_detection(w: &mut Writer, d: &Detection) {
    for part in [&d.position[..], &d.orientation, &d.velocity] {
        w.f64s(part)
    }
    d.aabb.min.iter().chain(&d.aabb.max).for_each(|x| w.0.extend(x.to_le_bytes()));
}

fn put_hello(w: &mut Writer, h: &Hello) {
    w.0.extend(b"BROADSID");
    w.u32(1);
    w.u32(h.offers);
    w.u32(h.is_exact as u32);
    w.f64s(&[h.margin_m]);
    for text in [h.id, h.build, h.what] {
        w.text(text)
    }
    w.u32(h.settings.len() as u32);
    for (key, default, what) in &h.settings {
        w.text(key);
        w.u64(*default);
        w.text(what);
    }
    w.u32(h.declared.len() as u32);
    for (key, value) in &h.declared {
        w.text(key);
        w.text(value);
    }
}

fn answer(engine: &mut dyn Engine, call: u32, r: &mut Reader, w: &mut Writer) -> Done {
    match call {
        1 => put_hello(w, &engine.hello()),
        2 => {
            let n = r.u32();
            engine.create(&(0..n).map(|_| r.u64()).collect::<Vec<_>>())?
        }
        3 => {
            let n = r.u32();
            let boxes: Vec<_> = (0..n).map(|_| r.aabb()).collect();
            engine.load_boxes(&boxes, &r.0.iter().map(|flag| *flag != 0).collect::<Vec<_>>())?
        }
        4 => {
            let n = r.u32();
            engine.update_boxes(&(0..n).map(|_| r.aabb()).collect::<Vec<_>>())?
        }
        5 => engine.find_pairs()?,
        6 => w.rows(&engine.pairs(), r.u64(), put_pair),
        10 => engine.begin(&r.scene())?,
        11 => {
            let seconds = engine.step(r.f64())?;
            if engine.hello().offers & STEP_SECONDS != 0 {
                w.f64s(&[seconds])
            }
        }
        12 => w.rows(&engine.states(), r.u64(), put_state),
        13 => w.rows(&engine.points(), r.u64(), put_point),
        15 => w.rows(&engine.detection(), r.u64(), put_detection),
        16 => w.rows(&engine.step_pairs(), r.u64(), put_pair),
        17 => engine.end(),
        _ => return Err(format!("there is no call {call} here")),
    }
    Ok(())
}

pub fn serve(engine: &mut dyn Engine) {
    let (mut input, mut output) = (std::io::stdin().lock(), std::io::stdout().lock());
    let mut head = [0u8; 4];
    while input.read_exact(&mut head).is_ok() {
        let mut message = vec![0u8; u32::from_le_bytes(head) as usize];
        if input.read_exact(&mut message).is_err() {
            return;
        }
        let mut r = Reader(&message);
        let call = r.u32();
        let (mut status, mut payload) = (0u32, Writer::default());
        if let Err(why) = answer(engine, call, &mut r, &mut payload) {
            status = 1;
            payload = Writer::default();
            payload.text(&why.chars().take(500).collect::<String>());
        }
        let mut frame = Writer::default();
        frame.u32(payload.0.len() as u32 + 4);
        frame.u32(status);
        frame.0.extend(payload.0);
        if output.write_all(&frame.0).and_then(|()| output.flush()).is_err() {
            return;
        }
    }
}
