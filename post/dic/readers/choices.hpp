// The choices of [measurement]; docs/dic_settings.md says what each of them means.
#pragma once

#include "core/keys/choice.hpp"

namespace weaveform::dic {

// measurement.format
enum class MeasurementFormat { automatic, aramis, dice, vic, pyvale, opencorr, matchid, matrix, columns };
constexpr auto choices_of(MeasurementFormat) {
  return std::to_array<Choice<MeasurementFormat>>({{MeasurementFormat::automatic, "auto"},
                                                   {MeasurementFormat::aramis, "aramis"},
                                                   {MeasurementFormat::dice, "dice"},
                                                   {MeasurementFormat::vic, "vic"},
                                                   {MeasurementFormat::pyvale, "pyvale"},
                                                   {MeasurementFormat::opencorr, "opencorr"},
                                                   {MeasurementFormat::matchid, "matchid"},
                                                   {MeasurementFormat::matrix, "matrix"},
                                                   {MeasurementFormat::columns, "columns"}});
}

// measurement.length_unit
enum class MeasuredUnit { automatic, mm, cm, m, um, in, px };
constexpr auto choices_of(MeasuredUnit) {
  return std::to_array<Choice<MeasuredUnit>>({{MeasuredUnit::automatic, "auto"},
                                              {MeasuredUnit::mm, "mm"},
                                              {MeasuredUnit::cm, "cm"},
                                              {MeasuredUnit::m, "m"},
                                              {MeasuredUnit::um, "um"},
                                              {MeasuredUnit::in, "in"},
                                              {MeasuredUnit::px, "px"}});
}

// measurement.y_axis
enum class YAxis { automatic, up, down };
constexpr auto choices_of(YAxis) {
  return std::to_array<Choice<YAxis>>({{YAxis::automatic, "auto"}, {YAxis::up, "up"}, {YAxis::down, "down"}});
}

// measurement.position
enum class PositionOf { reference, current };
constexpr auto choices_of(PositionOf) {
  return std::to_array<Choice<PositionOf>>({{PositionOf::reference, "reference"}, {PositionOf::current, "current"}});
}

// measurement.grid_zeros
enum class GridZeros { automatic, measured, missing };
constexpr auto choices_of(GridZeros) {
  return std::to_array<Choice<GridZeros>>(
      {{GridZeros::automatic, "auto"}, {GridZeros::measured, "measured"}, {GridZeros::missing, "missing"}});
}

}  // namespace weaveform::dic
