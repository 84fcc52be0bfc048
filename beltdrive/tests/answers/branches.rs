//! Branches of steady states.

use super::*;

#[test]
fn a_branch_as_a_table() {
    let found = traced(
        &drive("kim2009-flat", &[]),
        "load.tight_tension",
        [300.0, 3000.0],
    );
    insta::assert_snapshot!(shown(&branch::answer(&found)), @r"
    Kim 2009, tables 1 and 2, flat belt
    elastic/perfectly-plastic friction, μ = 1.2, k_f = 8.1e7 N/m², normal force n = (T − G V)/R
    Branch over load.tight_tension: 52 states

      tight   driven     speed     wrap     wrap     slip     slip   driven
    tension    speed      loss   driver   driven   driver   driven   torque  efficiency  event
          N      rpm         %        °        °        °        °      N·m           %
    300.000  1144.49  0.124576  180.000  180.000  1.97030        0  8.12401     99.8754  start
    364.714  1143.57  0.205048  180.000  180.000  11.5848        0  13.3814     99.7950  +slip, driven
    412.500  1142.89  0.264408  180.000  180.000  17.6185  6.03663  17.2635     99.7356
    581.250  1140.49  0.473693  180.000  180.000  34.3428  22.7750  30.9728     99.5263
    750.000  1138.09  0.682550  180.000  180.000  46.7192  35.1711  44.6821     99.3175
    918.750  1135.70  0.891113  180.000  180.000  56.5566  45.0341  58.3914     99.1089
    1087.50  1133.32   1.09952  180.000  180.000  64.7289  53.2386  72.1007     98.9005
    1256.25  1130.93   1.30793  180.000  180.000  71.7263  60.2746  85.8101     98.6921
    1425.00  1128.54   1.51648  180.000  180.000  77.8509  66.4448  99.5194     98.4835
    1593.75  1126.14   1.72534  180.000  180.000  83.3026  71.9492  113.229     98.2747
    1762.50  1123.75   1.93467  180.000  180.000  88.2204  76.9272  126.938     98.0653
    1931.25  1121.34   2.14466  180.000  180.000  92.7049  81.4798  140.648     97.8553
    2100.00  1118.92   2.35548  180.000  180.000  96.8315  85.6827  154.357     97.6445
    2268.75  1116.50   2.56735  180.000  180.000  100.658  89.5939  168.066     97.4327
    2437.50  1114.05   2.78047  180.000  180.000  104.230  93.2594  181.776     97.2195
    2606.25  1111.59   2.99509  180.000  180.000  107.583  96.7158  195.485     97.0049
    2775.00  1109.12   3.21144  180.000  180.000  110.747  99.9933  209.195     96.7886
    2943.75  1106.61   3.42982  180.000  180.000  113.746  103.117  222.904     96.5702
    3000.00  1105.77   3.50311  180.000  180.000  114.713  104.127  227.474     96.4969  end

          tight  estimated
        tension      error  event
              N          N
        300.000          0  the branch starts
    364.7144712    8.1e−14  a zone of slip friction appears on the driven pulley
        3000.00          0  the branch ends

    method                                     closed form
    states                                              55

    end of the branch: the parameter reached the value asked for
    ");
}

#[test]
fn a_branch_has_points_events_and_an_end() {
    let drive = drive("kim2009", &[]);
    let found = traced(&drive, "load.tight_tractive_tension", [6000.0, 9000.0]);
    let answer = branch::answer(&found);
    fits(&answer);
    let text = shown(&answer);
    for needle in [
        "  fold\n",
        "  90°, driver\n",
        "limit point: the tight tractive tension turns back\n",
    ] {
        assert!(text.contains(needle), "{needle} is not in\n{text}");
    }
    assert!(text.lines().count() < 60, "{text}");
    let report = parsed(&answer);
    assert_eq!(
        [&report["parameter"], &report["unit"]],
        ["load.tight_tractive_tension", "N"]
    );
    let points = report["points"].as_array().unwrap();
    assert_eq!(points.len(), found.points.len());
    for (report, point) in points.iter().zip(&found.points) {
        has(report, &STATE);
        close(&report["tight_tractive_tension_N"], point.value);
        close(&report["value"], point.value);
        close(&report["driven"]["torque_N_m"], point.state.driven.torque);
        has(report, &["/arclength", "/error_estimate"]);
    }
    let events = report["events"].as_array().unwrap();
    let kinds: Vec<_> = events.iter().map(|event| &event["kind"]).collect();
    assert_eq!(kinds, ["start", "overhang", "fold", "end"]);
    let fold = &events[2];
    has(fold, &STATE);
    assert!(fold["pulley"].is_null() && fold["zone"].is_null());
    close(&fold["value_error"], found.events[2].value_error.unwrap());
    let errors = found.events[2].errors.unwrap();
    close(
        &fold["errors"]["driven"]["torque_N_m"],
        errors.driven.torque,
    );
    assert_eq!(events[1]["pulley"], "driver");
    assert_eq!(report["end"]["reason"], "returned");
    assert!(report["convergence"]["continuation_steps"].is_u64());
    // The states of events are rows among the others.
    let table = columns(&csv(&answer));
    assert_eq!(
        table.0[..4],
        ["tight_tractive_tension_N", "arclength", "event", "pulley"]
    );
    let repeated = table
        .0
        .iter()
        .filter(|name| *name == "tight_tractive_tension_N");
    assert_eq!(repeated.count(), 1);
    let rows = 0..table.1.len();
    assert!(rows.len() >= points.len());
    let marked = rows
        .clone()
        .filter(|row| !field(&table, *row, "event").is_empty());
    assert_eq!(marked.count(), events.len());
    let fold = rows
        .clone()
        .find(|row| field(&table, *row, "event") == "fold")
        .unwrap();
    let event = &found.events[2].point;
    assert_eq!(
        field(&table, fold, "tight_tractive_tension_N").parse(),
        Ok(event.value)
    );
    let speed = "driven_angular_speed_rad_per_s";
    assert_eq!(
        field(&table, fold, speed).parse(),
        Ok(event.state.driven.angular_speed)
    );
    let exit = event.state.driver.inclination[1].to_degrees();
    assert_eq!(
        field(&table, fold, "driver_exit_inclination_deg").parse(),
        Ok(exit)
    );
    let along: Vec<_> = rows
        .map(|row| field(&table, row, "arclength").parse::<f64>().unwrap())
        .collect();
    assert!(along.is_sorted());
}

#[test]
fn a_branch_over_an_angle_is_in_degrees_and_says_why_it_failed() {
    let drive = drive("kim2009-bristle", &[]);
    let angle = 18_f64.to_radians();
    let mut found = traced(&drive, "groove.half_angle", [angle, 0.3]);
    let report = parsed(&branch::answer(&found));
    assert_eq!(report["unit"], "°");
    close(&report["points"][0]["half_angle_deg"], angle.to_degrees());
    found.end = BranchEnd::NotConverged {
        cause: "a cause ".repeat(20),
    };
    found.points[0].value = -1.234_567e-9;
    found.points[0].state.driven.torque = -1.234_567_8e6;
    let answer = branch::answer(&found);
    fits(&answer);
    assert_eq!(parsed(&answer)["end"]["reason"], "not converged");
}
