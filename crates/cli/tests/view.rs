//! The page: written as a site, or served to this machine and nobody else.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use std::fs;
use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};

use serde_json::Value;

fn closeranks(folder: &Path, arguments: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_closeranks"));
    command.current_dir(folder).args(arguments.split(' '));
    command
}

fn ended(folder: &Path, arguments: &str) -> Output {
    closeranks(folder, arguments).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// A program that serves the page, ended when this is dropped.
struct Served {
    child: Child,
    host: String,
}

impl Served {
    fn new(folder: &Path, arguments: &str) -> Self {
        let mut child = closeranks(folder, arguments).stdout(Stdio::piped()).spawn().unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let host = line.trim().strip_prefix("http://").unwrap().trim_end_matches('/').to_owned();
        Self { child, host }
    }

    /// The status, the head and the body of what is answered.
    fn ask(&self, request: &str) -> (String, String, Vec<u8>) {
        let mut stream = TcpStream::connect(&self.host).unwrap();
        stream.write_all(request.as_bytes()).unwrap();
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).unwrap();
        let end = answer.windows(4).position(|window| window == b"\r\n\r\n").unwrap();
        let head = text(&answer[..end]);
        let status = head.split(' ').nth(1).unwrap().to_owned();
        (status, head, answer[end + 4..].to_vec())
    }

    fn get(&self, path: &str) -> (String, String, Vec<u8>) {
        self.ask(&format!("GET {path} HTTP/1.1\r\nHost: {}\r\n\r\n", self.host))
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[test]
fn a_site_is_written_with_the_scenario_beside_the_page() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("mine.toml"), "# mine\nseed = 7\n").unwrap();
    let output = ended(folder.path(), "view mine.toml --export site");
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let read = |name: &str| fs::read(folder.path().join("site").join(name)).unwrap();
    assert!(text(&read("index.html")).contains("content=\"scenario.toml\""));
    assert_eq!(text(&read("scenario.toml")), "# mine\nseed = 7\n");
    assert!(read("closeranks.wasm").starts_with(b"\0asm"));
    assert!(!read("page.js").is_empty() && !read("page.css").is_empty());
    let again = ended(folder.path(), "view --export site");
    assert_eq!(again.status.code(), Some(2), "another command's folder is not replaced");
    assert_eq!(ended(folder.path(), "view --export site --overwrite").status.code(), Some(0));
    assert!(!folder.path().join("site/scenario.toml").exists());
}

#[test]
fn the_page_is_served_to_this_machine_and_to_its_own_name_only() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("mine.toml"), "seed = 7\n").unwrap();
    let served = Served::new(folder.path(), "view mine.toml");
    assert!(served.host.starts_with("127.0.0.1:"));
    let (status, head, body) = served.get("/");
    assert_eq!(status, "200");
    assert!(head.contains("Content-Type: text/html") && head.contains("nosniff"), "{head}");
    assert!(text(&body).starts_with("<!doctype html>"));
    let (status, head, body) = served.get("/closeranks.wasm");
    assert!(status == "200" && head.contains("application/wasm") && body.starts_with(b"\0asm"), "{head}");
    assert!(head.contains(&format!("Content-Length: {}", body.len())));
    assert_eq!(text(&served.get("/scenario.toml").2), "seed = 7\n");
    for path in ["/../Cargo.toml", "/mine.toml", "/etc/passwd", "//"] {
        assert_eq!(served.get(path).0, "404", "{path}");
    }
    assert_eq!(served.ask("GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n").0, "403");
    assert_eq!(served.ask(&format!("POST / HTTP/1.1\r\nHost: {}\r\n\r\n", served.host)).0, "405");
    let (status, _, body) = served.ask(&format!("HEAD / HTTP/1.1\r\nHost: {}\r\n\r\n", served.host));
    assert!(status == "200" && body.is_empty());
    let long = format!("GET / HTTP/1.1\r\nA: {}\r\n", "a".repeat(8200));
    assert_eq!(served.ask(&long).0, "400");
}

#[test]
fn a_recorded_run_is_shown_by_the_scenario_that_it_carries() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("short.toml"), "name = \"short\"\nduration_s = 0.1\n").unwrap();
    assert_eq!(ended(folder.path(), "run short.toml --seed 5 -o out").status.code(), Some(0));
    let output = ended(folder.path(), "view out/run.parquet --export site");
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let scenario = fs::read_to_string(folder.path().join("site/scenario.toml")).unwrap();
    assert!(scenario.contains("name = \"short\"") && scenario.contains("seed = 5"), "{scenario}");
}

#[test]
fn what_the_page_cannot_show_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |scenario: &str, message: &str| {
        fs::write(folder.path().join("a.toml"), scenario).unwrap();
        let output = ended(folder.path(), "view a.toml --export site");
        assert_eq!(output.status.code(), Some(2));
        assert!(text(&output.stderr).contains(message), "{}", text(&output.stderr));
        assert!(!folder.path().join("site").exists());
    };
    refused("dimension = 3\n", "is 3, allowed on the page is 2");
    refused("[team]\nrobots = 201\n", "is 201, allowed on the page is at most 200");
    refused("seed = -1\n", "`seed` is -1");
}

#[test]
fn every_run_ends_with_its_digest() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a.toml"), "duration_s = 0.2\n").unwrap();
    let digest = |arguments: &str| {
        let output = ended(folder.path(), arguments);
        let numbers: Value = serde_json::from_slice(&output.stdout).unwrap();
        numbers["digest"].as_str().unwrap().to_owned()
    };
    let plain = digest("run a.toml --json");
    assert_eq!(plain.len(), 16);
    assert_eq!(digest("run a.toml --json -o out"), plain, "a recorded run is the same run");
    assert_ne!(digest("run a.toml --json --seed 2"), plain);
    let told = text(&ended(folder.path(), "run a.toml").stdout);
    assert!(told.ends_with(&format!("digest: {plain}\n")), "{told}");
}
