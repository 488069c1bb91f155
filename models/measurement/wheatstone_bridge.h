// Decides the voltage of a Wheatstone bridge with two strain gauges across from each other, and what the gauges read
// from it. Does not decide what stretches them.
#pragma once

namespace hysteron::wheatstone_bridge {

/// R_s = R_r (1 + K strain): gauge of factor K and rest resistance R_r [Ohm].
template <class T>
T gauge_resistance(const T& resistance, const T& gauge_factor, const T& strain) {
  return resistance * (T{1} + gauge_factor * strain);
}

/// Voltage between the dividers R_2-R_3 and R_1-R_4 that hang on the supply u_AC, R_1 = R_3 = R_r fixed and
/// R_2 = R_4 = R_s gauges:
///
///   u_BD = u_AC ( R_3/(R_2 + R_3) - R_4/(R_1 + R_4) ) = u_AC (R_r - R_s)/(R_r + R_s)
///
/// Falls with the strain. Source: thesis Eq. 3.1 with R_4 over R_1 + R_4; the printed R_1 there makes a bridge of two
/// equal dividers, which reads zero whatever the gauges do.
template <class T>
T voltage(const T& supply, const T& resistance, const T& gauge) {
  return supply * (resistance - gauge) / (resistance + gauge);
}

/// R_s = R_r (2 u_AC/(u_AC + u_BD) - 1), the inverse of voltage(). Source: thesis Eq. 3.2 as corrected.
template <class T>
T gauge_from_voltage(const T& supply, const T& resistance, const T& voltage) {
  return resistance * (T{2} * supply / (supply + voltage) - T{1});
}

/// Strain of a gauge of that resistance: the inverse of gauge_resistance().
template <class T>
T strain_from_gauge(const T& resistance, const T& gauge_factor, const T& gauge) {
  return (gauge / resistance - T{1}) / gauge_factor;
}

}  // namespace hysteron::wheatstone_bridge
