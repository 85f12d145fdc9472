// SPDX-License-Identifier: MIT
// The rungs of the ladder in reduced form: each meets its bar, and refuses what is wrong in its scene.
#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include <hearth/furnace/rung.hpp>

using namespace hearth::furnace;

namespace {

std::unique_ptr<rung> scene(const std::string& kind, std::initializer_list<const char*> assignments = {}) {
    auto made = parse_rung("kind = \"" + kind + "\"");
    made->set_keys({assignments.begin(), assignments.end()});
    return made;
}

std::string complaint(const std::string& text) {
    try {
        parse_rung(text, "my.toml");
    } catch (const bad_scene& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("ladder: every kind has a document that reads back, a plan that says what it leaves out, and refuses foreign keys") {
    for (const scene_kind& kind : scene_kinds()) {
        if (kind.name == "furnace") continue;
        CAPTURE(kind.name);
        const auto made = scene(kind.name);
        CHECK(made->kind() == kind.name);
        CHECK(parse_rung(made->document())->document() == made->document());
        made->set_keys({"title=other"});
        CHECK(hash(*made) != hash(*scene(kind.name)));
        CHECK(parse_rung(made->document())->title() == "other");
        const rung_plan planned = made->foresee();
        CHECK(planned.left_out.size() >= 2);
        CHECK(planned.seconds > 0);
        CHECK(complaint("kind = \"" + kind.name + "\"\ntitel = \"x\"") ==
              "my.toml:2: titel is not a key of a scene; the nearest one is title");
        CHECK_THROWS_WITH_AS(made->set_keys({"burners.count=3"}), doctest::Contains("--set burners.count=3: burners"),
                             bad_scene);
    }
}

TEST_CASE("ladder: a kind that does not exist is refused with those that do") {
    CHECK(complaint("\nkind = \"sylo\"").find("my.toml:2: kind is \"sylo\", allowed: furnace, ") == 0);
    CHECK(complaint("kind = 3") == "my.toml:1: kind is not a text in quotes");
    CHECK(complaint("title = \"x\"") == "my.toml: kind is \"furnace\", which is no rung of the ladder");
}

TEST_CASE("ladder: heat through a contact rises with the third root of the force, whatever the motion's softness") {
    const rung_result r = scene("two_spheres", {"contact.forces_N=[1, 10, 100]"})->run();
    // Hertz is exact for what DEM computes; what is left is the spheres' coming to rest, and round-off.
    CHECK(r["exponent_two_spheres"] == doctest::Approx(1.0 / 3).epsilon(1e-9));
    CHECK(r["exponent_sphere_and_wall"] == doctest::Approx(1.0 / 3).epsilon(1e-9));
    CHECK(r["wall_over_pair"] == doctest::Approx(std::cbrt(2.0)).epsilon(1e-9));
    CHECK(r["hertz_error"] < 1e-9);
    for (const double error : r.column("over_modulus.csv", "by_force_error")) CHECK(error < 1e-9);
    // Batchelor and O'Brien's formula by hand for steel, E 2e11 Pa, nu 0.29, k 45 W/(m K), R* 4.95 mm:
    // H = 2.916e-3 W/K at 1 N.
    CHECK(r.column("heat_over_force.csv", "two_spheres_W")[0] == doctest::Approx(2.916e-2).epsilon(1e-3));
    CHECK(complaint("kind = \"two_spheres\"\n[particles]\nsoftened_modulus_Pa = 1e12") ==
          "particles.softened_modulus_Pa is 1e+12, allowed: at most particles.modulus_Pa, 2e+11");
}

TEST_CASE("ladder: a bed between plates conducts as Yagi and Kunii's within 25 %, by radiation more the hotter it is") {
    const rung_result r = scene("plates", {"vessel.radius_in_diameters=5.5", "vessel.fill_height_in_diameters=22",
                                           "heat.temperatures_K=[400, 800, 1100]", "heat.compared_cutoffs=[1.001, 2.5, 4]"})
                              ->run();
    CHECK(r["largest_departure_percent"] < 25);  // the bar for Fig. 3
    CHECK(r["radiation_share_first_percent"] < 35);
    CHECK(r["radiation_share_last_percent"] > 65);
    const auto& k = r.column("conductivity.csv", "radiation_W_per_mK");
    // Links that are the same at all temperatures radiate with the cube of the temperature, but for the plates' 20 K.
    CHECK(k[2] / k[0] == doctest::Approx(std::pow(1100.0 / 400, 3)).epsilon(0.03));
    const auto& whole = r.column("conductivity.csv", "between_plates_W_per_mK");
    const auto& core = r.column("conductivity.csv", "core_W_per_mK");
    for (std::size_t i = 0; i < whole.size(); ++i) CHECK(whole[i] < core[i]);  // plates are a resistance
}

TEST_CASE("ladder: the pressure drop of a cold bed in a tube is Eisfeld and Schnitzlein's within 15 %, and no solid is lost") {
    const rung_result r = scene("cold_bed", {"gas.velocities_m_per_s=[0.5, 2]", "mesh.cells_per_diameter=1.5", "voidage.compare=false",
                                             "mesh.compared_cells_per_diameter=[1]"})
                              ->run();
    CHECK(r["drop_departure_percent"] < 15);  // their data scatter by 11 to 16 %
    // Its drag is Ergun's, which does not know that a tube's wall makes the bed easier to pass at high velocity; the void
    // fraction varies within the bed, which makes 2 to 5 %.
    CHECK(r["ergun_departure_percent"] < 10);
    CHECK(r.warnings.empty());
    CHECK(r["bed_height_m"] == doctest::Approx(0.145).epsilon(0.15));  // a bed of ten layers ends at one of them
    CHECK(r["void_fraction"] > 0.36);
    CHECK(r["void_fraction"] < 0.48);
    CHECK_THROWS_AS(r["filtered_lost_solid_percent"], std::out_of_range);
    // Between the powers 1 and 2 of the velocity, as Re 400 to 2000 has it.
    const auto& drop = r.column("pressure_drop.csv", "filtered_Pa");
    CHECK(drop[1] / drop[0] > 8);
    CHECK(drop[1] / drop[0] < 16);
    CHECK(complaint("kind = \"cold_bed\"\nbed.height_m = 0.1") == "bed.height_m is 0.1, allowed: at least 8 diameters, 0.112");
}

TEST_CASE("ladder: the heated bed follows Schumann, and lags by the law where the gas stores as the paper has it") {
    const auto bed = scene("heated_bed", {"time.duration_s=400", "time.step_s=0.01", "mesh.cells=100", "time.samples=100",
                                          "time.acceleration_factors=[50, 200]"});
    const rung_result r = bed->run();
    // The bar for the method is 1 K of 100 K; a fifth of it is left for cells of 1.5 mm and steps of 0.01 s.
    CHECK(r["gamma_1_error_K"] < 0.2);
    CHECK(r["paper_deviation_percent"] == doctest::Approx(r["delay_law_percent"]).epsilon(0.05));  // (Gamma - 1) beta xi = 0.17
    CHECK(r["corrected_deviation_percent"] < 0.2);
    CHECK(r["energy_imbalance"] < 1e-12);
    // Twice the Gamma, twice the error: the first-order law, within what it says of itself.
    const auto& law = r.column("over_gamma.csv", "law_K");
    const auto& error = r.column("over_gamma.csv", "paper_error_K");
    for (std::size_t k = 0; k < law.size(); ++k) CHECK(error[k] == doctest::Approx(law[k]).epsilon(0.1));
    CHECK(complaint("kind = \"heated_bed\"\n[bed]\nheights_mm = [20, 0]") ==
          "my.toml:3: bed.heights_mm is 0, allowed: 1 to 100000");
    CHECK(complaint("kind = \"heated_bed\"\n[bed]\nheights_mm = 20") == "my.toml:3: bed.heights_mm is not a list of numbers");
    CHECK(complaint("kind = \"heated_bed\"\nbed.heights_mm = [200]") ==
          "bed.heights_mm holds 200, allowed: up to the bed's height, 150");
}

TEST_CASE("ladder: a silo's wall carries, its bed sinks as a plug, and its masses are exact") {
    const rung_result r = scene("silo", {"silo.diameter_m=0.1", "silo.height_m=0.45", "silo.fillings=3", "flow.mass_flow_kg_per_s=1",
                                         "flow.duration_s=1.5"})
                              ->run();
    CHECK(r["weight_imbalance_percent"] < 2);  // what rests still trembles
    CHECK(r["floor_over_head"] < 0.9);
    // Janssen's K lies between active, 0.3, and isotropic where the wall's friction is wholly used; pouring leaves part unused.
    CHECK(r["janssen_coefficient"] > 0.1);
    CHECK(r["janssen_coefficient"] < 1);
    // Sums of a few hundred masses, each to round-off.
    CHECK(std::fabs(r["mass_imbalance_kg"]) < 1e-12);
    CHECK(r["flow_error"] < 1e-12);
    CHECK(r["fed_over_flow"] == doctest::Approx(1).epsilon(1e-12));
    CHECK(r["sinking_over_plug"] == doctest::Approx(1).epsilon(0.15));  // of a bed that slackens as it starts to sink
    CHECK(r["wall_over_centre"] > 0.5);  // rubbing on the wall holds the outer layer back; a funnel would leave it at rest
    CHECK(complaint("kind = \"silo\"\n[particles]\nlargest_mm = 10") ==
          "particles.largest_mm is 10, allowed: at least particles.smallest_mm, 16");
}

TEST_CASE("ladder: a burner's gas burns in a hot bed and not in a cold one, and keeps its elements") {
    const rung_result r = scene("burner", {"slab.depth_m=0.16", "slab.width_m=0.1", "slab.height_m=0.24", "burner.height_m=0.1",
                                           "burner.mass_flow_kg_per_s=0.005", "particles.temperatures_K=[800, 1800]", "mesh.cell_m=0.02"})
                              ->run();
    CHECK(r.warnings.empty());
    CHECK(std::fabs(r["burn_out_first"]) < 1e-6);  // below 900 K nothing reacts
    CHECK(r["burn_out_last"] > 0.99);
    CHECK(r["flame_limit_K"] == 1800);
    // Changes of a thousandth of the greatest velocity and 1e-4 of a mass fraction are left at the end.
    CHECK(r["element_imbalance"] < 1e-4);
    CHECK(r["unfinished_reactions"] == 0);
    CHECK(r["hottest_gas_K"] > 1800);
    CHECK(complaint("kind = \"burner\"\nburner.height_m = 0.8") == "burner.height_m is 0.8, allowed: below the slab's top, 0.5");
}
