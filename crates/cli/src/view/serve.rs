//! A web server for one page and this machine alone. It answers GET and HEAD for the files of the page and refuses the rest.

use core::net::Ipv4Addr;
use core::sync::atomic::{AtomicUsize, Ordering};
use core::time::Duration;
use std::io::{self, Read as _, Write as _};
use std::net::{TcpListener, TcpStream};
use std::thread;

use anyhow::{Context, Result};

use super::moments::Feed;
use super::site::{MOMENTS, MOMENTS_KIND, Site};
use crate::output;

/// Longest head of a request, bytes.
const HEAD_MAX: usize = 8192;
/// Requests that are answered at once; more are turned away.
const AT_ONCE: usize = 32;
/// How long a browser may take to ask, and to listen.
const PATIENCE: Duration = Duration::from_secs(5);

/// Serves `site`, and the lines of a live source if there is one, until the program is ended.
pub(crate) fn serve(site: &Site, live: Option<&Live<'_>>, port: u16) -> Result<()> {
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port)).with_context(|| {
        format!("cannot listen on port {port} of this machine; allowed is a free one, or 0")
    })?;
    let port = listener.local_addr()?.port();
    output::say(&format!("http://127.0.0.1:{port}/\nCtrl-C ends it.\n"));
    let busy = AtomicUsize::new(0);
    thread::scope(|scope| {
        if let Some(live) = live {
            scope.spawn(|| live.follow());
        }
        for stream in listener.incoming().flatten() {
            if busy.fetch_add(1, Ordering::Relaxed) >= AT_ONCE {
                busy.fetch_sub(1, Ordering::Relaxed);
                continue;
            }
            scope.spawn(|| {
                // Whoever went away needs no answer.
                let _ = answer(stream, site, live.map(|live| live.feed), port);
                busy.fetch_sub(1, Ordering::Relaxed);
            });
        }
    });
    Ok(())
}

/// A source of moments that goes on while the page is served.
pub(crate) struct Live<'a> {
    pub(crate) feed: &'a Feed,
    pub(crate) source: &'a std::io::Stdin,
    pub(crate) robots: u16,
}

impl Live<'_> {
    fn follow(&self) {
        if let Err(error) = self.feed.follow(&mut self.source.lock(), self.robots) {
            output::note(&format!("the live source is no longer followed: {error:#}"));
        }
    }
}

fn answer(mut stream: TcpStream, site: &Site, feed: Option<&Feed>, port: u16) -> io::Result<()> {
    stream.set_read_timeout(Some(PATIENCE))?;
    stream.set_write_timeout(Some(PATIENCE))?;
    let Some(head) = head(&mut stream)? else {
        return refuse(&mut stream, "400 Bad Request");
    };
    match Request::parse(&head, port) {
        Ok(Request { path, with_body: true })
            if path.strip_prefix('/') == Some(MOMENTS) && feed.is_some() =>
        {
            feed.map_or(Ok(()), |feed| stream_lines(&mut stream, feed))
        }
        Ok(Request { path, with_body }) => match site.at(path) {
            Some(file) => {
                let kind = format!("{}\r\nContent-Length: {}", file.kind, file.bytes.len());
                let body = if with_body { &*file.bytes } else { &[] };
                send(&mut stream, "200 OK", &kind, body)
            }
            None => refuse(&mut stream, "404 Not Found"),
        },
        Err(status) => refuse(&mut stream, status),
    }
}

/// Sends the lines of a live source until it ends or the reader goes away.
fn stream_lines(stream: &mut TcpStream, feed: &Feed) -> io::Result<()> {
    // In chunks, so that the reader can tell the end from a connection that broke.
    send(stream, "200 OK", &format!("{MOMENTS_KIND}\r\nTransfer-Encoding: chunked"), b"")?;
    let mut seen = None;
    while let Some(lines) = feed.next(&mut seen) {
        stream.write_all(format!("{:x}\r\n{lines}\r\n", lines.len()).as_bytes())?;
        stream.flush()?;
    }
    stream.write_all(b"0\r\n\r\n")
}

/// The head of a request, up to the empty line; none if it is too long or ends before.
fn head(stream: &mut TcpStream) -> io::Result<Option<String>> {
    let mut bytes = Vec::new();
    let mut part = [0; 1024];
    while !bytes.windows(4).any(|window| window == b"\r\n\r\n") {
        let count = stream.read(&mut part)?;
        bytes.extend_from_slice(&part[..count]);
        if count == 0 || bytes.len() > HEAD_MAX {
            return Ok(None);
        }
    }
    Ok(String::from_utf8(bytes).ok())
}

/// What is asked for.
#[derive(Debug, PartialEq)]
struct Request<'a> {
    path: &'a str,
    with_body: bool,
}

impl<'a> Request<'a> {
    /// Reads a head, or says which status refuses it. A page of another site that has a name for this machine is refused: its
    /// host is not ours.
    fn parse(head: &'a str, port: u16) -> Result<Self, &'static str> {
        let mut lines = head.split("\r\n");
        let mut words = lines.next().unwrap_or_default().split(' ');
        let (Some(method), Some(target), Some(version)) = (words.next(), words.next(), words.next()) else {
            return Err("400 Bad Request");
        };
        if !version.starts_with("HTTP/1.") || words.next().is_some() {
            return Err("400 Bad Request");
        }
        let with_body = match method {
            "GET" => true,
            "HEAD" => false,
            _ => return Err("405 Method Not Allowed"),
        };
        let fields = || lines.clone().filter_map(|line| line.split_once(':'));
        let hosts =
            fields().filter(|(name, _)| name.eq_ignore_ascii_case("host")).map(|(_, host)| host.trim());
        let ours = [format!("127.0.0.1:{port}"), format!("localhost:{port}")];
        let mut hosts = hosts.peekable();
        if hosts.peek().is_none() || !hosts.all(|host| ours.iter().any(|our| our == host)) {
            return Err("403 Forbidden");
        }
        let path = target.split(['?', '#']).next().unwrap_or_default();
        Ok(Self { path, with_body })
    }
}

fn refuse(stream: &mut TcpStream, status: &str) -> io::Result<()> {
    let body = format!("{status}\n");
    let kind = format!("text/plain; charset=utf-8\r\nContent-Length: {}", body.len());
    send(stream, status, &kind, body.as_bytes())
}

fn send(stream: &mut TcpStream, status: &str, kind: &str, body: &[u8]) -> io::Result<()> {
    let head = format!(
        "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\nCache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\n\
         Cross-Origin-Resource-Policy: same-origin\r\nX-Frame-Options: DENY\r\nConnection: close\r\n\r\n"
    );
    stream.write_all(head.as_bytes())?;
    stream.write_all(body)?;
    stream.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn requests_are_read_or_refused() {
        let read = |line: &str, host: &str| {
            let head = format!("{line}\r\nAccept: */*\r\n{host}\r\n\r\n");
            Request::parse(&head, 80).map(|request| (request.path.to_owned(), request.with_body))
        };
        let good = "Host: 127.0.0.1:80";
        assert_eq!(read("GET / HTTP/1.1", good), Ok(("/".to_owned(), true)));
        assert_eq!(
            read("HEAD /page.js?a=1 HTTP/1.0", "hOST: localhost:80"),
            Ok(("/page.js".to_owned(), false))
        );
        assert_eq!(read("POST / HTTP/1.1", good), Err("405 Method Not Allowed"));
        for line in ["", "GET", "GET /", "GET / HTTP/2", "GET / HTTP/1.1 more"] {
            assert_eq!(read(line, good), Err("400 Bad Request"), "{line}");
        }
        for host in
            ["", "Host: evil.example:80", "Host: 127.0.0.1", "Host: 127.0.0.1:80\r\nHost: evil.example"]
        {
            assert_eq!(read("GET / HTTP/1.1", host), Err("403 Forbidden"), "{host}");
        }
    }
}
