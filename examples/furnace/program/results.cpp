// SPDX-License-Identifier: MIT
#include "results.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <sstream>
#include <utility>

#include <hearth/io/vtkhdf.hpp>

#include "picture.hpp"
#include "provenance.hpp"
#include "text_files.hpp"

namespace hearth::furnace::program {
namespace {

namespace fs = std::filesystem;

std::vector<float> single(const std::vector<double>& values) { return {values.begin(), values.end()}; }

std::vector<float> single(const std::vector<std::array<double, 3>>& vectors) {
    std::vector<float> out;
    for (const auto& v : vectors) {
        for (const double x : v) out.push_back(static_cast<float>(x));
    }
    return out;
}

std::vector<double> flat(const std::vector<std::array<double, 3>>& vectors) {
    std::vector<double> out;
    for (const auto& v : vectors) out.insert(out.end(), v.begin(), v.end());
    return out;
}

/// Why a number is not there, as far as the scene tells.
std::string reason(const std::string& key, const settings& scene) {
    const auto is = [&](const char* word) { return key.find(word) != std::string::npos; };
    if (is("nitric_oxide") && !scene.physics.nitric_oxide) return "physics.nitric_oxide = false";
    if (is("carbon_monoxide") && scene.physics.combustion == burning::mixed_is_burnt) {
        return "physics.combustion = \"mixed_is_burnt\" knows no carbon monoxide";
    }
    if (is("solids_outlet")) return "no solids have left the furnace yet";
    if (is("product_share") || is("median_time")) return "no solids have come all the way from above the burners to the bottom yet";
    if (is("centre_minus_wall")) return "no particles in the centre or at the wall at that height";
    return "this scene does not compute it";
}

}  // namespace

void history::add(const status& now) {
    rows.insert(rows.end(), {static_cast<double>(now.couplings), now.process_time, now.peak_particle_temperature, now.peak_height,
                             now.offgas_temperature, now.solids_outlet_temperature, now.pressure_drop, now.enthalpy_imbalance});
}

/// Rank 0 writes; where it cannot, all ranks throw.
template <class Write>
void results::on_first(Write&& write) const {
    std::string wrong;
    bool failed = false;
    try {
        if (among_.rank() == 0) write();
    } catch (const io::file_error& error) {
        failed = true;
        wrong = error.what();
    }
    if (among_.any(failed)) throw io::file_error(wrong);
}

results::results(fs::path folder, ranks among) : folder_(std::move(folder)), among_(std::move(among)) {
    on_first([&] { make_folder(folder_); });
}

void results::frame(int count, const furnace& shaft) const {
    const snapshot seen = shaft.look();
    on_first([&] { frame_of(count, seen, shaft.cells()); });
}

void results::frame_of(int count, const snapshot& seen, const cell_shapes& shapes) const {
    const auto path = [&](const char* stem) {
        char name[40];
        std::snprintf(name, sizeof name, "%s_%04d.hdf", stem, count);
        return (folder_ / name).string();
    };
    io::vtkhdf_file particles(path("particles"), io::vertices(flat(seen.particle_position)), seen.process_time, MPI_COMM_SELF);
    const auto particle_field = [&](const char* name, const std::vector<double>& values) {
        if (!values.empty()) particles.point_field(name, single(values));
    };
    std::vector<double> diameter;
    for (const double radius : seen.particle_radius) diameter.push_back(2 * radius);
    particle_field("diameter_m", diameter);
    particle_field("temperature_K", seen.particle_temperature);
    particle_field("heat_transfer_coefficient_W_per_m2K", seen.heat_transfer_coefficient);
    particles.close();

    io::grid_piece grid;
    grid.points = flat(shapes.points);
    grid.offsets.push_back(0);
    for (const auto& corners : shapes.cells) {
        grid.connectivity.insert(grid.connectivity.end(), corners.begin(), corners.end());
        grid.offsets.push_back(static_cast<std::int64_t>(grid.connectivity.size()));
    }
    constexpr std::uint8_t vtk_hexahedron = 12;
    grid.types.assign(shapes.cells.size(), vtk_hexahedron);
    io::vtkhdf_file cells(path("cells"), grid, seen.process_time, MPI_COMM_SELF);
    const auto cell_field = [&](const std::string& name, const std::vector<double>& values) {
        if (!values.empty()) cells.cell_field(name, single(values));
    };
    cell_field("void_fraction", seen.void_fraction);
    cell_field("temperature_K", seen.gas_temperature);
    cell_field("pressure_Pa", seen.pressure);
    if (!seen.superficial_velocity.empty()) {
        cells.cell_field("superficial_velocity_m_per_s", single(seen.superficial_velocity), 3);
    }
    for (const auto& [gas, values] : seen.mole_fraction) cell_field("mole_fraction_" + gas, values);
    cells.close();
}

void results::scene(const settings& s) const {
    on_first([&] { write_text(folder_ / "scene.toml", document(s)); });
}

void results::end(const furnace& shaft, const snapshot& seen, const history& watched) const {
    const axial_profile now = shaft.axial();
    on_first([&] { end_of(shaft, now, seen, watched); });
}

void results::end_of(const furnace& shaft, const axial_profile& now, const snapshot& seen, const history& watched) const {
    write_text(folder_ / "profiles.csv",
               csv{{{"height_m", &now.height},
                    {"particle_temperature_K", &now.particle_temperature},
                    {"particle_temperature_centre_K", &now.particle_temperature_centre},
                    {"particle_temperature_wall_K", &now.particle_temperature_wall},
                    {"gas_temperature_K", &now.gas_temperature},
                    {"pressure_Pa", &now.pressure},
                    {"void_fraction", &now.void_fraction},
                    {"heat_by_convection_W_per_m", &now.convection},
                    {"heat_by_radiation_W_per_m", &now.radiation},
                    {"heat_by_conduction_W_per_m", &now.conduction},
                    {"heat_from_wall_W_per_m", &now.wall}}}
                   .text());
    const shaft_profile& guess = shaft.profile();
    write_text(folder_ / "one_dimensional.csv", csv{{{"height_m", &guess.height},
                                                     {"particle_temperature_K", &guess.particle_temperature},
                                                     {"gas_temperature_K", &guess.gas_temperature},
                                                     {"pressure_Pa", &guess.pressure},
                                                     {"heat_transfer_coefficient_W_per_m2K", &guess.heat_transfer_coefficient}}}
                                                    .text());
    std::string table =
        "coupling,process_time_s,peak_particle_temperature_K,peak_height_m,offgas_temperature_K,solids_outlet_temperature_K,"
        "pressure_drop_Pa,enthalpy_imbalance_W\n";
    for (std::size_t k = 0; k < watched.rows.size(); ++k) {
        table += number(watched.rows[k]) + ((k + 1) % history::columns == 0 ? '\n' : ',');
    }
    write_text(folder_ / "history.csv", table);
    write_text(folder_ / "picture.json", picture_data(shaft, seen));
    write_text(folder_ / "picture.py", picture_script());
}

void results::summary_file(const furnace& shaft, const snapshot& seen, const summary& s, const plan& planned, const std::string& also) const {
    on_first([&] {
        const std::string text = json(shaft, seen, s, planned, among_.size());
        write_text(folder_ / "summary.json", text);
        if (!also.empty()) write_text(also, text);
    });
}

std::string json(const furnace& shaft, const snapshot& seen, const summary& s, const plan& planned, int ranks) {
    std::string out = "{\n  \"title\": " + quoted(shaft.scene().title) + ",\n";
    std::string absent;
    for_each_number(s, [&](const char* key, const summary::number& value) {
        const bool known = value.has_value() && std::isfinite(*value);
        out += "  " + quoted(key) + ": " + (known ? number(*value) : "null") + ",\n";
        if (known) return;
        absent += (absent.empty() ? "\n" : ",\n") + ("    " + quoted(key)) + ": " +
                  quoted(value.has_value() ? "it is not finite" : reason(key, shaft.scene()));
    });
    const auto times = [&](const char* key, const std::vector<summary::timing>& list) {
        out += "  " + quoted(key) + ": {";
        for (std::size_t k = 0; k < list.size(); ++k) out += (k == 0 ? "" : ", ") + quoted(list[k].name) + ": " + number(list[k].seconds);
        out += "},\n";
    };
    times("time_per_phase_s", s.phases);
    times("time_per_module_s", s.modules);
    out += std::string("  \"converged\": ") + (s.converged ? "true" : "false") + ",\n  \"warnings\": [";
    for (std::size_t k = 0; k < s.warnings.size(); ++k) out += (k == 0 ? "" : ", ") + quoted(s.warnings[k]);
    out += "],\n  \"left_out\": [";
    for (std::size_t k = 0; k < planned.left_out.size(); ++k) {
        const plan::omission& o = planned.left_out[k];
        out += (k == 0 ? "" : ", ") + ("{\"what\": " + quoted(o.what)) + ", \"because\": " + quoted(o.because) + ", \"saves\": " +
               quoted(o.saves) + "}";
    }
    out += "],\n  \"absent\": {" + absent + (absent.empty() ? "" : "\n  ") + "},\n";
    out += "  \"version\": " + quoted(version()) + ",\n  \"scene_hash\": " + quoted(hexadecimal(hash(shaft.scene()))) +
           ",\n  \"answer_hash\": " + quoted(hexadecimal(answer_hash(seen))) + ",\n  \"ranks\": " + std::to_string(ranks) + "\n}\n";
    return out;
}

std::uint64_t answer_hash(const snapshot& seen) {
    std::uint64_t value = 14695981039346656037U;
    const auto mix = [&](const auto& values) {
        for (const auto& item : values) {
            unsigned char bytes[sizeof item];
            std::memcpy(bytes, &item, sizeof item);
            for (const unsigned char byte : bytes) value = (value ^ byte) * 1099511628211U;
        }
    };
    mix(seen.particle_position);
    mix(seen.particle_temperature);
    mix(seen.void_fraction);
    mix(seen.gas_temperature);
    mix(seen.pressure);
    mix(seen.superficial_velocity);
    for (const auto& [gas, values] : seen.mole_fraction) mix(values);
    return value;
}

}  // namespace hearth::furnace::program
