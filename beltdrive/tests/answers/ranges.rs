//! Limits of a load, and their curves.

use super::*;

#[test]
fn the_limits_of_a_flat_belt_as_a_table() {
    insta::assert_snapshot!(shown(&of_limits(&drive("kim2009-flat", &[]))), @r"
    Kim 2009, tables 1 and 2, flat belt
    elastic/perfectly-plastic friction, μ = 1.2, k_f = 8.1e7 N/m², normal force n = (T − G V)/R
    Limits of load.tight_tension
    smallest: both spans have the same tension: the drive transmits no torque
    largest: the belt slips grossly on the driver

                                                       smallest                     largest
    tight tension                                       200.000                 8332.837395  N
    reason                                              no load                driver slips
    belt length, unstretched                            908.240                     877.924  mm
    slack span                                          200.000                     200.000  mm
    tight span                                          200.000                     200.000  mm
    mass flow                                           1.00758                    0.625222  kg/s
    speed loss                                                0                     38.7106  %
    efficiency                                          100.000                     61.2894  %
    friction loss                                             0                     30694.2  W
    driver: speed                                       1145.92                     1145.92  rpm
    driver: torque                                            0                     660.762  N·m
    driver: power                                             0                     79.2914  kW
    driver: wrap angle                                  180.000                     180.000  °
    driver: slip arc                                          0                     177.953  °
    driver: reference tension T_o                       200.000                     49288.8  N
    driver: entry strain                                      0                   −0.511515
    driver: smallest k_f with slip                    not known                           –  N/mm²
    driven: speed                                       1145.92                     702.325  rpm
    driven: torque                                            0                     660.762  N·m
    driven: power                                             0                     48.5972  kW
    driven: wrap angle                                  180.000                     180.000  °
    driven: slip arc                                          0                     177.909  °
    driven: reference tension T_o                       200.000                    −786.010  N
    driven: entry strain                                      0                   0.0123147
    driven: smallest k_f with slip                    not known                           –  N/mm²
    slack belt tension T                                200.000                     200.000  N
    tight belt tension T                                200.000                     8332.84  N
    slack tractive tension F                            190.176                     196.217  N
    tight tractive tension F                            190.176                     8328.67  N

    method                                     closed form
    states                                              63
    ");
}

#[test]
fn each_limit_has_value_reason_and_state() {
    let drive = drive("kim2009-flat", &[]);
    let answer = of_limits(&drive);
    let report = parsed(&answer);
    assert_eq!(
        [&report["parameter"], &report["unit"]],
        ["load.tight_tension", "N"]
    );
    for end in ["smallest", "largest"] {
        has(&report[end], &STATE);
        assert_eq!(report[end]["value"], report[end]["tight_tension_N"]);
        has(
            &report[end],
            &[
                "/value_error",
                "/description",
                "/warnings",
                "/error_estimate",
            ],
        );
    }
    let (smallest, largest) = (&report["smallest"], &report["largest"]);
    assert_eq!(
        [&smallest["reason"], &largest["reason"]],
        ["no load", "gross slip"]
    );
    assert!(smallest["pulley"].is_null() && largest["pulley"] == "driver");
    assert!(largest["errors"]["driven"]["torque_N_m"].as_f64().unwrap() > 0.0);
    has(&report, &["/convergence/continuation_steps"]);
    let table = columns(&csv(&answer));
    let first = [
        "limit",
        "tight_tension_N",
        "value_error",
        "reason",
        "pulley",
    ];
    assert_eq!(table.0[..5], first);
    assert_eq!(table.1.len(), 2);
    assert_eq!(field(&table, 1, "reason"), "gross slip");
    assert_eq!(field(&table, 1, "normal_force"), "inertia");
    let torque = largest["driven"]["torque_N_m"].as_f64().unwrap();
    assert_eq!(field(&table, 1, "driven_torque_N_m").parse(), Ok(torque));
    let repeated = table.0.iter().filter(|name| *name == "tight_tension_N");
    assert_eq!(repeated.count(), 1);
}

#[test]
fn a_limit_curve_as_a_table() {
    let mut found = curve(&drive("kim2009-flat", &[]), [0.4, 0.6]);
    found.cusps = vec![found.points[3].clone()];
    insta::assert_snapshot!(shown(&limit_curve::answer(&found)), @r"
    Kim 2009, tables 1 and 2, flat belt
    elastic/perfectly-plastic friction, μ varied, k_f = 8.1e7 N/m², normal force n = (T − G V)/R
    Limit of load.tight_tension over friction.coefficient: 41 limits

    coefficient        tight   driven   driven                 slip     slip
    of friction      tension    speed   torque  efficiency   driver   driven  reason
                           N      rpm      N·m           %        °        °
       0.400000  678.3733957  1085.44  38.8635     94.7224  179.253  179.251  driver slips
       0.410000  699.7277797  1083.67  40.5983     94.5678  179.238  179.236  driver slips
       0.420000  721.7648739  1081.86  42.3887     94.4097  179.223  179.220  driver slips
       0.430000  744.5065426  1080.00  44.2362     94.2481  179.207  179.205  driver slips
       0.440000  767.9753527  1078.11  46.1429     94.0829  179.191  179.189  driver slips
       0.450000  792.1945964  1076.17  48.1105     93.9139  179.176  179.173  driver slips
       0.460000  817.1883148  1074.19  50.1410     93.7411  179.160  179.157  driver slips
       0.470000  842.9813217  1072.17  52.2365     93.5643  179.144  179.141  driver slips
       0.480000  869.5992291  1070.10  54.3990     93.3834  179.128  179.125  driver slips
       0.490000  897.0684729  1067.97  56.6307     93.1984  179.112  179.109  driver slips
       0.500000  925.4163393  1065.80  58.9337     93.0090  179.096  179.093  driver slips
       0.510000  954.6709928  1063.58  61.3104     92.8153  179.080  179.076  driver slips
       0.520000  984.8615045  1061.31  63.7631     92.6170  179.064  179.060  driver slips
       0.530000  1016.017881  1058.99  66.2944     92.4141  179.047  179.043  driver slips
       0.540000  1048.171096  1056.61  68.9066     92.2065  179.031  179.026  driver slips
       0.550000  1081.353121  1054.17  71.6024     91.9940  179.014  179.009  driver slips
       0.560000  1115.596957  1051.68  74.3844     91.7765  178.997  178.992  driver slips
       0.570000  1150.936667  1049.13  77.2555     91.5539  178.981  178.975  driver slips
       0.580000  1187.407417  1046.52  80.2185     91.3261  178.964  178.958  driver slips
       0.590000  1225.045501  1043.85  83.2763     91.0930  178.947  178.941  driver slips
       0.600000  1263.888388  1041.11  86.4320     90.8544  178.930  178.924  driver slips

    coefficient        tight
    of friction      tension  cusp
                           N
       0.415000  710.6596377  two limit points meet and vanish

    method                                     closed form
    states                                              41

    end of the curve: the parameter reached the value asked for
    ");
}

#[test]
fn each_limit_of_a_curve_has_both_parameters() {
    let mut found = curve(&drive("kim2009-flat", &[]), [0.4, 0.6]);
    found.cusps = vec![found.points[3].clone()];
    let answer = limit_curve::answer(&found);
    fits(&answer);
    let report = parsed(&answer);
    assert_eq!(report["parameter"], "load.tight_tension");
    assert_eq!(
        [&report["second_parameter"], &report["second_unit"]],
        ["friction.coefficient", ""]
    );
    let (limit, point) = (&report["points"][3], &found.points[3]);
    has(limit, &STATE);
    close(&limit["coefficient"], point.second);
    close(&limit["second_value"], point.second);
    close(&limit["tight_tension_N"], point.value);
    close(&limit["value"], point.value);
    assert_eq!(
        [&limit["reason"], &limit["pulley"]],
        ["gross slip", "driver"]
    );
    assert_eq!(&report["cusps"][0], limit);
    assert_eq!(report["end"]["reason"], "target");
    let table = columns(&csv(&answer));
    let first = [
        "coefficient",
        "tight_tension_N",
        "value_error",
        "reason",
        "pulley",
    ];
    assert_eq!(table.0[..5], first);
    assert_eq!(table.1.len(), found.points.len());
    assert_eq!(field(&table, 0, "coefficient"), "0.4");
}
