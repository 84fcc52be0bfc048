//! The columns of tables of many states: one list for branches, one for limit curves, by kind of belt.

use super::shown::Shown;
use crate::{BeltKind, Drive};

/// A column with a scalar of the states.
#[derive(Clone, Copy)]
pub(super) struct TableColumn {
    /// Two lines of what it is, and its unit.
    heads: [&'static str; HEADS],
    width: usize,
    cell: fn(&Shown<'_>) -> String,
}

/// Lines of the head of a table.
pub(super) const HEADS: usize = 3;

impl TableColumn {
    const fn wide(self, width: usize) -> Self {
        Self { width, ..self }
    }
}

/// The columns of a branch besides the parameter and the event.
pub(super) fn of_branch(drive: &Drive) -> &'static [TableColumn] {
    match drive.belt.kind {
        BeltKind::V(_) => &V_BRANCH,
        BeltKind::Flat { .. } => &FLAT_BRANCH,
    }
}

/// The columns of a limit curve besides both parameters and the reason.
pub(super) fn of_limit_curve(drive: &Drive) -> &'static [TableColumn] {
    match drive.belt.kind {
        BeltKind::V(_) => &V_LIMITS,
        BeltKind::Flat { .. } => &FLAT_LIMITS,
    }
}

/// A line of the head over the columns.
pub(super) fn head(columns: &[TableColumn], line: usize) -> String {
    let cells = columns.iter();
    cells
        .map(|column| format!("{:>1$}", column.heads[line], column.width))
        .collect()
}

/// The cells of a state.
pub(super) fn cells(columns: &[TableColumn], state: &Shown<'_>) -> String {
    let cells = columns.iter();
    cells
        .map(|column| format!("{:>1$}", (column.cell)(state), column.width))
        .collect()
}

const V_BRANCH: [TableColumn; 7] = [
    SPEED,
    LOSS,
    DRIVER_WRAP.wide(9),
    DRIVEN_WRAP.wide(9),
    TORQUE,
    EFFICIENCY,
    EXIT,
];

const FLAT_BRANCH: [TableColumn; 8] = [
    SPEED,
    LOSS,
    DRIVER_WRAP,
    DRIVEN_WRAP,
    DRIVER_SLIP,
    DRIVEN_SLIP,
    TORQUE,
    EFFICIENCY,
];

const V_LIMITS: [TableColumn; 4] = [
    SPEED.wide(12),
    TORQUE.wide(12),
    EFFICIENCY.wide(10),
    EXIT.wide(10),
];

const FLAT_LIMITS: [TableColumn; 5] = [
    SPEED.wide(12),
    TORQUE.wide(12),
    EFFICIENCY,
    DRIVER_SLIP.wide(9),
    DRIVEN_SLIP.wide(9),
];

const SPEED: TableColumn = TableColumn {
    heads: ["driven", "speed", "rad/s"],
    width: 10,
    cell: |state| state.driven_speed(),
};

const LOSS: TableColumn = TableColumn {
    heads: ["speed", "loss", "%"],
    width: 9,
    cell: |state| state.speed_loss(),
};

const DRIVER_WRAP: TableColumn = TableColumn {
    heads: ["wrap", "driver", "°"],
    width: 8,
    cell: |state| state.angle(state.driver().wrap_angle),
};

const DRIVEN_WRAP: TableColumn = TableColumn {
    heads: ["angle", "driven", "°"],
    width: 8,
    cell: |state| state.angle(state.driven().wrap_angle),
};

const DRIVER_SLIP: TableColumn = TableColumn {
    heads: ["slip", "driver", "°"],
    width: 8,
    cell: |state| state.slip_arc(state.driver()),
};

const DRIVEN_SLIP: TableColumn = TableColumn {
    heads: ["arc", "driven", "°"],
    width: 8,
    cell: |state| state.slip_arc(state.driven()),
};

const TORQUE: TableColumn = TableColumn {
    heads: ["driven", "torque", "N·m"],
    width: 9,
    cell: |state| state.driven_torque(),
};

const EFFICIENCY: TableColumn = TableColumn {
    heads: ["effi-", "ciency", "%"],
    width: 9,
    cell: |state| state.efficiency(),
};

const EXIT: TableColumn = TableColumn {
    heads: ["exit of", "driver", "°"],
    width: 9,
    cell: |state| state.angle(state.driver().inclination[1]),
};
