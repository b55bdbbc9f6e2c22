//! The simulator for a web page: functions that take and give numbers, and texts through two buffers.
//!
//! The caller writes a text into the buffer that [`input`] makes and calls a function with its length. A function that answers with
//! a text gives its length, and the text lies at [`output`]. Frames are 64-bit floats at the address that [`frame`] gives. Addresses
//! are good until the next call. Worlds have handles; a call with a handle that is none does nothing and answers 0.
//!
//! Everything that comes in is checked: texts by the reader of scenarios, sizes here.

mod facts;
mod network;
mod session;

use core::cell::RefCell;

use serde_json::{Value, json};
use session::Session;

/// Longest text that is taken, bytes.
const INPUT_MAX: usize = closeranks_sim::parse::TEXT_MAX;
/// Worlds that may be open at once.
const SESSIONS_MAX: usize = 16;
/// Ticks that one call computes at most.
const TICKS_MAX: u32 = 1 << 20;

#[derive(Default)]
struct Module {
    input: Vec<u8>,
    output: Vec<u8>,
    sessions: Vec<Option<Session>>,
}

thread_local! {
    static MODULE: RefCell<Module> = RefCell::default();
}

fn with<T>(call: impl FnOnce(&mut Module) -> T) -> T {
    MODULE.with_borrow_mut(call)
}

/// Calls `call` with an open world; 0 if there is none of that handle.
fn with_session<T: Default>(handle: u32, call: impl FnOnce(&mut Session) -> T) -> T {
    with(|module| {
        module.sessions.get_mut(handle as usize).and_then(Option::as_mut).map(call).unwrap_or_default()
    })
}

/// Leaves an answer in the output buffer and gives its length.
fn answer(value: &Value) -> u32 {
    with(|module| {
        module.output = value.to_string().into_bytes();
        u32::try_from(module.output.len()).unwrap_or(u32::MAX)
    })
}

/// The text of so many bytes in the input buffer, or why it is none.
fn text(length: u32) -> Result<String, Value> {
    let bytes = with(|module| module.input.get(..length as usize).map(<[u8]>::to_vec)).unwrap_or_default();
    String::from_utf8(bytes).map_err(|error| {
        let found = format!("byte {} is not UTF-8", error.utf8_error().valid_up_to());
        json!([{ "line": 1, "message": found }])
    })
}

/// Makes room for a text of so many bytes and gives its address; 0 if that is more than is taken.
#[unsafe(no_mangle)]
#[allow(unsafe_code, reason = "the name alone; nothing in here is unsafe")]
pub extern "C" fn input(length: u32) -> *mut u8 {
    with(|module| {
        if length as usize > INPUT_MAX {
            return core::ptr::null_mut();
        }
        module.input.clear();
        module.input.resize(length as usize, 0);
        module.input.as_mut_ptr()
    })
}

/// Where the last answer lies.
#[unsafe(no_mangle)]
#[allow(unsafe_code, reason = "the name alone; nothing in here is unsafe")]
pub extern "C" fn output() -> *const u8 {
    with(|module| module.output.as_ptr())
}

/// What the page needs to know of this build: version, controllers, laws.
#[unsafe(no_mangle)]
#[allow(unsafe_code, reason = "the name alone; nothing in here is unsafe")]
pub extern "C" fn about() -> u32 {
    answer(&facts::about())
}

/// The TOML text of the input buffer as JSON: `{"table": ..}`, or `{"problems": [..]}`.
#[unsafe(no_mangle)]
#[allow(unsafe_code, reason = "the name alone; nothing in here is unsafe")]
pub extern "C" fn table(length: u32) -> u32 {
    answer(&match text(length).and_then(|text| facts::table(&text)) {
        Ok(table) => json!({ "table": table }),
        Err(problems) => json!({ "problems": problems }),
    })
}

/// Opens a world for the scenario in the input buffer and computes its first tick: `{"handle": .., "facts": ..}`, or
/// `{"problems": [{"line": .., "message": ..}]}`.
#[unsafe(no_mangle)]
#[allow(unsafe_code, reason = "the name alone; nothing in here is unsafe")]
pub extern "C" fn open(length: u32) -> u32 {
    let opened = text(length).and_then(|text| Session::open(&text)).and_then(|session| {
        let facts = session.facts();
        let handle = with(|module| {
            let free = module.sessions.iter().position(Option::is_none);
            let place = free.unwrap_or(module.sessions.len());
            if place >= SESSIONS_MAX {
                return None;
            }
            if place == module.sessions.len() {
                module.sessions.push(None);
            }
            module.sessions[place] = Some(session);
            Some(place)
        });
        let found = format!("{SESSIONS_MAX} worlds are open, and no more are allowed");
        handle.map(|handle| (handle, facts)).ok_or_else(|| json!([{ "line": 1, "message": found }]))
    });
    answer(&match opened {
        Ok((handle, facts)) => json!({ "handle": handle, "facts": facts }),
        Err(problems) => json!({ "problems": problems }),
    })
}

/// Closes a world.
#[unsafe(no_mangle)]
#[allow(unsafe_code, reason = "the name alone; nothing in here is unsafe")]
pub extern "C" fn close(handle: u32) {
    with(|module| {
        if let Some(session) = module.sessions.get_mut(handle as usize) {
            *session = None;
        }
    });
}

/// Computes up to so many ticks, not beyond the last of the scenario; gives how many were computed since the start.
#[unsafe(no_mangle)]
#[allow(unsafe_code, reason = "the name alone; nothing in here is unsafe")]
pub extern "C" fn step(handle: u32, ticks: u32) -> u32 {
    with_session(handle, |session| session.step(ticks.min(TICKS_MAX)))
}

/// As [`step`], while robot `robot` (from 1) is drawn towards a point, m, at up to the speed of 1 m/s.
#[unsafe(no_mangle)]
#[allow(unsafe_code, reason = "the name alone; nothing in here is unsafe")]
pub extern "C" fn pull(handle: u32, ticks: u32, robot: u32, x_m: f64, y_m: f64) -> u32 {
    with_session(handle, |session| session.pull(ticks.min(TICKS_MAX), robot, [x_m, y_m]))
}

/// The address of the last tick as numbers: see `session::FIELDS`; null if there is no such world.
#[unsafe(no_mangle)]
#[allow(unsafe_code, reason = "the name alone; nothing in here is unsafe")]
pub extern "C" fn frame(handle: u32) -> *const f64 {
    with(|module| {
        let session = module.sessions.get_mut(handle as usize).and_then(Option::as_mut);
        session.map_or(core::ptr::null(), |session| session.frame().as_ptr())
    })
}

/// What became of the laws so far.
#[unsafe(no_mangle)]
#[allow(unsafe_code, reason = "the name alone; nothing in here is unsafe")]
pub extern "C" fn report(handle: u32) -> u32 {
    let report = with_session(handle, |session| Some(session.report()));
    answer(&report.unwrap_or_default())
}

/// The exact robustness of the network as it is now, as far as a search of so many nodes finds it.
#[unsafe(no_mangle)]
#[allow(unsafe_code, reason = "the name alone; nothing in here is unsafe")]
pub extern "C" fn network(handle: u32, nodes: u32) -> u32 {
    let network = with_session(handle, |session| Some(session.network(nodes)));
    answer(&network.unwrap_or_default())
}

/// The digest of all ticks so far, as `closeranks run` prints it.
#[unsafe(no_mangle)]
#[allow(unsafe_code, reason = "the name alone; nothing in here is unsafe")]
pub extern "C" fn digest(handle: u32) -> u64 {
    with_session(handle, |session| session.digest())
}
