// SPDX-License-Identifier: MIT
// The rungs of the ladder in reduced form: each meets its bar, and refuses what is wrong in its scene.
#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <string>

#include <hearth/furnace/rung.hpp>

using namespace hearth::furnace;

namespace {

std::unique_ptr<rung> scene(const std::string& kind, std::initializer_list<const char*> assignments = {}) {
    auto made = parse_rung("kind = \"" + kind + "\"");
    for (const char* assignment : assignments) made->set_key(assignment);
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
        made->set_key("title=other");
        CHECK(hash(*made) != hash(*scene(kind.name)));
        CHECK(parse_rung(made->document())->title() == "other");
        const rung_plan planned = made->foresee();
        CHECK(planned.left_out.size() >= 2);
        CHECK(planned.seconds > 0);
        CHECK(complaint("kind = \"" + kind.name + "\"\ntitel = \"x\"") ==
              "my.toml:2: titel is not a key of a scene; the nearest one is title");
        CHECK_THROWS_WITH_AS(made->set_key("burners.count=3"), doctest::Contains("--set: burners"), bad_scene);
    }
}

TEST_CASE("ladder: a kind that does not exist is refused with those that do") {
    CHECK(complaint("\nkind = \"sylo\"").find("my.toml:2: kind is \"sylo\", allowed: furnace, ") == 0);
    CHECK(complaint("kind = 3") == "my.toml:1: kind is not a text in quotes");
    CHECK(complaint("title = \"x\"") == "my.toml: kind is \"furnace\", which is no rung of the ladder");
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
