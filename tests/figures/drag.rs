//! How smooth it is to drag the thing over the table, in a real browser.

use crate::chromium::Page;
use crate::suite::Suite;
use serde_json::{Value, json};

/// Moves that are measured, one a frame.
const MOVES: u32 = 300;

/// Drags the target around the table, a step a frame: what a step costs the page with its layout, and how long the frames are.
pub fn measure() -> Value {
    let mut suite = Suite::start("figures-drag", &["--demonstrator", "human"]);
    let address = suite.page_url();
    let mut page = Page::open(&address, 1280, 860);
    page.wait("open question", "!document.getElementById('skip').disabled");
    let of = page.value(&format!(
        "(async () => {{
            const target = document.getElementById('target'), table = document.getElementById('table');
            const box = table.getBoundingClientRect(), frame = () => new Promise(requestAnimationFrame);
            // Only the browser may capture a pointer that exists; this one does not.
            target.setPointerCapture = target.releasePointerCapture = () => {{}};
            const send = (type, turn) => target.dispatchEvent(new PointerEvent(type, {{
                bubbles: true, pointerId: 1, isPrimary: true, button: 0, buttons: 1,
                clientX: box.x + box.width * (0.5 + 0.25 * Math.cos(turn)), clientY: box.y + box.height * (0.45 + 0.25 * Math.sin(turn)),
            }}));
            send('pointerdown', 0);
            const step = [], frames = [], seen = new Set();
            let last = await frame();
            for (let n = 1; n <= {MOVES}; n++) {{
                const begin = performance.now();
                send('pointermove', n / 20);
                table.getBoundingClientRect();
                step.push(performance.now() - begin);
                seen.add(target.dataset.x);
                const next = await frame();
                frames.push(next - last);
                last = next;
            }}
            send('pointerup', {MOVES} / 20);
            return {{ step, frames, moved: seen.size }};
        }})()"
    ));
    let numbers = |name: &str| -> Vec<f64> { serde_json::from_value(of[name].clone()).expect("numbers") };
    json!({
        "moved": of["moved"],
        "a step with its layout, ms": crate::percentiles(numbers("step")),
        "a frame, ms": crate::percentiles(numbers("frames")),
    })
}
