//! Chromium without a window, driven by the Chrome DevTools Protocol over a pipe: JSON documents
//! that end with a zero byte, written to its file descriptor 3 and read from 4.

use std::collections::VecDeque;
use std::env;
use std::io::{BufRead as _, BufReader, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::thread;
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use tempfile::TempDir;

/// Longest wait for an answer or an event.
const PATIENCE: Duration = Duration::from_secs(60);

/// Names under which it is installed, in the order of trying.
const NAMES: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "chrome"];

/// Chromium's program, from `CHROMIUM` or the path; nothing where there is none.
pub fn program() -> Option<PathBuf> {
    if let Some(given) = env::var_os("CHROMIUM") {
        return Some(given.into());
    }
    let path = env::var_os("PATH")?;
    let folders: Vec<PathBuf> = env::split_paths(&path).collect();
    let candidates = NAMES.iter().flat_map(|name| folders.iter().map(move |at| at.join(name)));
    candidates.into_iter().find(|candidate| candidate.is_file())
}

/// A running browser; it ends with this value.
pub struct Browser {
    process: Child,
    commands: ChildStdin,
    answers: Receiver<Value>,
    /// Events that came while an answer was waited for.
    events: VecDeque<Value>,
    last_id: u64,
    _profile: TempDir,
}

/// A page of a browser, which must outlive it.
pub struct Page<'a> {
    browser: &'a mut Browser,
    session: String,
    target: String,
}

/// How a page is looked at.
#[derive(Debug, Clone, Copy)]
pub struct View {
    pub width: u32,
    pub height: u32,
    pub phone: bool,
    pub dark: bool,
}

impl Browser {
    pub fn start(program: &Path) -> Self {
        let profile = tempfile::tempdir().expect("a folder for the profile");
        // The shell gives the browser its pipe; it has no other way in.
        let mut process = Command::new("sh")
            .args(["-c", "exec \"$0\" \"$@\" 3<&0 4>&1 </dev/null >/dev/null 2>&1"])
            .arg(program)
            .args(["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic"])
            .args(["--no-first-run", "--disable-background-networking", "--disable-sync"])
            .args(["--disable-component-update", "--hide-scrollbars", "--disable-dev-shm-usage"])
            .args(["--allow-file-access-from-files", "--remote-debugging-pipe"])
            .arg(format!("--user-data-dir={}", profile.path().display()))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("a shell");
        let commands = process.stdin.take().expect("a pipe");
        let mut output = BufReader::new(process.stdout.take().expect("a pipe"));
        let (sender, answers) = channel();
        thread::spawn(move || {
            let mut document = Vec::new();
            while output.read_until(0, &mut document).is_ok_and(|length| length > 0) {
                document.pop();
                let message = serde_json::from_slice(&document).expect("JSON");
                document.clear();
                if sender.send(message).is_err() {
                    break;
                }
            }
        });
        let events = VecDeque::new();
        Self { process, commands, answers, events, last_id: 0, _profile: profile }
    }

    fn call(&mut self, session: Option<&str>, method: &str, parameters: Value) -> Value {
        self.last_id += 1;
        let mut command = json!({"id": self.last_id, "method": method, "params": parameters});
        if let Some(session) = session {
            command["sessionId"] = session.into();
        }
        write!(self.commands, "{command}\0").expect("the browser listens");
        let deadline = Instant::now() + PATIENCE;
        loop {
            let message = self.receive(deadline, method);
            if message["id"] == self.last_id {
                assert!(message["error"].is_null(), "{method}: {}", message["error"]);
                return message["result"].clone();
            }
            self.events.push_back(message);
        }
    }

    fn receive(&mut self, deadline: Instant, waiting_for: &str) -> Value {
        let left = deadline.saturating_duration_since(Instant::now());
        let message = self.answers.recv_timeout(left);
        message.unwrap_or_else(|why| panic!("the browser does not answer {waiting_for}: {why}"))
    }

    /// Opens an empty page.
    pub fn page(&mut self, view: View) -> Page<'_> {
        let made = self.call(None, "Target.createTarget", json!({"url": "about:blank"}));
        let target = text(&made["targetId"]);
        let attach = json!({"targetId": target, "flatten": true});
        let session = text(&self.call(None, "Target.attachToTarget", attach)["sessionId"]);
        self.events.clear();
        let mut page = Page { browser: self, session, target };
        for domain in ["Page", "Runtime", "Log", "Network"] {
            page.call(&format!("{domain}.enable"), json!({}));
        }
        page.look(view);
        page
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        let _ = write!(self.commands, "{}\0", json!({"id": 0, "method": "Browser.close"}));
        let deadline = Instant::now() + Duration::from_secs(5);
        while Instant::now() < deadline {
            if matches!(self.process.try_wait(), Ok(Some(_))) {
                return;
            }
            thread::sleep(Duration::from_millis(20));
        }
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

impl Page<'_> {
    fn call(&mut self, method: &str, parameters: Value) -> Value {
        self.browser.call(Some(&self.session), method, parameters)
    }

    /// Sets the window's size and the colour scheme that the reader prefers.
    pub fn look(&mut self, view: View) {
        let View { width, height, phone, dark } = view;
        let size = json!({
            "width": width, "height": height, "screenWidth": width, "screenHeight": height,
            "deviceScaleFactor": 1, "mobile": phone,
        });
        self.call("Emulation.setDeviceMetricsOverride", size);
        let scheme = if dark { "dark" } else { "light" };
        let features = json!([{"name": "prefers-color-scheme", "value": scheme}]);
        self.call("Emulation.setEmulatedMedia", json!({"features": features}));
    }

    /// Keeps the page's own scripts from running, from the next page on.
    pub fn without_scripts(&mut self) {
        self.call("Emulation.setScriptExecutionDisabled", json!({"value": true}));
    }

    /// Loads a file and waits until all of it is there.
    pub fn open(&mut self, file: &Path) {
        let went = self.call("Page.navigate", json!({"url": format!("file://{}", file.display())}));
        assert!(went["errorText"].is_null(), "{}: {}", file.display(), went["errorText"]);
        let deadline = Instant::now() + PATIENCE;
        let loaded = |event: &Value| event["method"] == "Page.loadEventFired";
        while !self.browser.events.iter().any(loaded) {
            let event = self.browser.receive(deadline, "Page.loadEventFired");
            self.browser.events.push_back(event);
        }
    }

    /// The value of an expression; a promise is awaited.
    pub fn evaluate(&mut self, expression: &str) -> Value {
        let asked = json!({"expression": expression, "returnByValue": true, "awaitPromise": true});
        let answer = self.call("Runtime.evaluate", asked);
        let thrown = &answer["exceptionDetails"];
        assert!(thrown.is_null(), "{thrown}\nin {}", &expression[..expression.len().min(300)]);
        answer["result"]["value"].clone()
    }

    /// Presses and releases a key, as `Enter` or `Tab`, where the focus is.
    pub fn press(&mut self, key: &str, code: u32, text: &str) {
        for kind in ["keyDown", "keyUp"] {
            let mut event =
                json!({"type": kind, "key": key, "code": key, "windowsVirtualKeyCode": code});
            if kind == "keyDown" && !text.is_empty() {
                event["text"] = text.into();
            }
            self.call("Input.dispatchKeyEvent", event);
        }
    }

    /// Moves the mouse with its button down from one point of the window to another, in steps.
    pub fn drag(&mut self, from: [f64; 2], to: [f64; 2], steps: u32) {
        let mut mouse = |kind: &str, [x, y]: [f64; 2]| {
            let event = json!({"type": kind, "x": x, "y": y, "button": "left", "buttons": 1, "clickCount": 1});
            self.call("Input.dispatchMouseEvent", event);
        };
        mouse("mousePressed", from);
        for step in 1..=steps {
            let part = f64::from(step) / f64::from(steps);
            mouse("mouseMoved", [0, 1].map(|k| from[k] + part * (to[k] - from[k])));
        }
        mouse("mouseReleased", to);
    }

    /// The page as it would be printed on A4 paper.
    pub fn print(&mut self) -> Vec<u8> {
        let wanted = json!({"preferCSSPageSize": true, "printBackground": true});
        base64(&text(&self.call("Page.printToPDF", wanted)["data"]))
    }

    /// What happened on the page so far: the protocol's events.
    pub fn events(&mut self) -> Vec<Value> {
        // An answer comes after the events that came before it.
        self.evaluate("0");
        let ours = |event: &&Value| event["sessionId"] == self.session.as_str();
        self.browser.events.iter().filter(ours).cloned().collect()
    }
}

impl Drop for Page<'_> {
    fn drop(&mut self) {
        if !thread::panicking() {
            let close = json!({"targetId": self.target});
            self.browser.call(None, "Target.closeTarget", close);
        }
    }
}

fn text(value: &Value) -> String {
    value.as_str().expect("a text").to_owned()
}

/// The bytes that a text in base 64 stands for.
fn base64(text: &str) -> Vec<u8> {
    let digit = |letter: u8| match letter {
        b'A'..=b'Z' => Some(letter - b'A'),
        b'a'..=b'z' => Some(letter - b'a' + 26),
        b'0'..=b'9' => Some(letter - b'0' + 52),
        b'+' => Some(62),
        b'/' => Some(63),
        _ => None,
    };
    let digits: Vec<u32> = text.bytes().filter_map(digit).map(u32::from).collect();
    let bytes = digits.chunks(4).flat_map(|four| {
        let whole = four.iter().fold(0, |sum, digit| sum << 6 | digit) << (6 * (4 - four.len()));
        [16, 8, 0].into_iter().map(move |shift| (whole >> shift) as u8).take(four.len() * 6 / 8)
    });
    bytes.collect()
}
