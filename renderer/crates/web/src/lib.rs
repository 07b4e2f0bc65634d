//! The kernel for a web page. A module without imports, whose exported functions pass numbers and places in its memory:
//!
//! ```js
//! const room = exports.room(file.length);                     // where the .m3ir file goes
//! new Uint8Array(exports.memory.buffer).set(file, room);
//! if (exports.open()) throw text(exports.text(), exports.text_length());
//! const pixels = exports.render(width, height, straight);     // width * height * 3 floats
//! ```
//!
//! One scene is open at a time. The module runs on the thread that calls it.

use std::cell::RefCell;

use m3d_ir::{Archive, Ir};
use m3d_kernel::camera::Size;
use m3d_kernel::options::Options;
use m3d_kernel::picture::picture;
use m3d_kernel::render::Settings;
use m3d_kernel::scene::Scene;

#[derive(Default)]
struct Open {
    file: Vec<u8>,
    scene: Option<(Scene, Settings)>,
    error: String,
    pixels: Vec<f32>,
}

thread_local! {
    static OPEN: RefCell<Open> = RefCell::default();
}

fn with<T>(work: impl FnOnce(&mut Open) -> T) -> T {
    OPEN.with(|open| work(&mut open.borrow_mut()))
}

/// Makes room for a file of so many bytes; returns where it goes.
#[unsafe(no_mangle)]
pub extern "C" fn room(bytes: usize) -> *const u8 {
    with(|open| {
        open.file = vec![0; bytes];
        open.file.as_ptr()
    })
}

/// Opens the scene of the file in the room. Returns 0, or 1 where it was refused; `text` then says why.
#[unsafe(no_mangle)]
pub extern "C" fn open() -> u32 {
    with(|open| match read(&open.file) {
        Ok(scene) => {
            open.scene = Some(scene);
            0
        }
        Err(error) => {
            open.error = error;
            1
        }
    })
}

fn read(file: &[u8]) -> Result<(Scene, Settings), String> {
    let archive = Archive::read(file).map_err(|error| error.to_string())?;
    let ir = Ir::new(&archive.header, &archive).map_err(|error| error.to_string())?;
    let settings = Settings {
        size: Size { width: 0, height: 0 },
        left: 0,
        top: 0,
        columns: 0,
        rows: 0,
        options: m3d_ir::options(&ir),
        outputs: Vec::new(),
    };
    Ok((m3d_ir::scene(&ir, 1).map_err(|error| error.to_string())?, settings))
}

/// Renders the open scene. Returns where the pixels are: three 32-bit floats each, row after row from the top left; 0
/// where no scene is open.
#[unsafe(no_mangle)]
pub extern "C" fn render(width: usize, height: usize, straight: bool) -> *const f32 {
    with(|open| {
        let Some((scene, settings)) = &open.scene else { return std::ptr::null() };
        let size = Size { width, height };
        let options = Options { straight, ..settings.options.clone() };
        let settings = Settings { size, columns: width, rows: height, options, ..settings.clone() };
        open.pixels = picture(scene, &settings);
        open.pixels.as_ptr()
    })
}

/// Where the text of the last error is, in UTF-8.
#[unsafe(no_mangle)]
pub extern "C" fn text() -> *const u8 {
    with(|open| open.error.as_ptr())
}

/// How many bytes it has.
#[unsafe(no_mangle)]
pub extern "C" fn text_length() -> usize {
    with(|open| open.error.len())
}
