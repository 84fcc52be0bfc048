//! The progress of long work on a terminal.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Divisions of the bar.
const DIVISIONS: f64 = 1000.0;

/// Does work that reports its share done, 0 to 1, and what it does; a bar on standard error shows
/// it. There is none where standard error is no terminal, or if nothing is to be shown.
pub(super) fn with_bar<T>(
    quiet: bool,
    work: impl FnOnce(&mut (dyn FnMut(f64, &str) + Send)) -> T,
) -> T {
    let target = if quiet {
        ProgressDrawTarget::hidden()
    } else {
        ProgressDrawTarget::stderr()
    };
    let bar = ProgressBar::with_draw_target(Some(divisions(1.0)), target);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {percent:>3} %  {elapsed}  {msg}") {
        bar.set_style(style);
    }
    let result = work(&mut |share, message| {
        bar.set_position(divisions(share));
        bar.set_message(message.to_owned());
    });
    bar.finish_and_clear();
    result
}

fn divisions(share: f64) -> u64 {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to the divisions of the bar"
    )]
    let divisions = (share.clamp(0.0, 1.0) * DIVISIONS) as u64;
    divisions
}
