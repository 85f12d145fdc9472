// SPDX-License-Identifier: MIT
// Figure 4 of Spijker et al. (2023, doi:10.1002/ceat.202200617): how the Volume Fraction Smoother works.
//
// Two particles larger than the cells give all their volume to the cells of their centres (a).  Sweep by sweep the
// over-full cells keep the threshold and pass the rest to neighbours that have not given yet (b, c), until none is
// over-full (d).  The sweeps are written out here in their plainest form; the last picture is hearth's result.  Both
// must be the same field.  Writes 02_smooth_a_lattice.svg.
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include <hearth/core/lattice.hpp>
#include <hearth/core/strided_cloud.hpp>
#include <hearth/voidage/deposit.hpp>
#include <hearth/voidage/vfs.hpp>

using field = std::vector<double>;

constexpr double threshold = 0.9;

/// One sweep of the paper's Eqs. 6 and 7 for cells of equal volume; false when no cell is over-full.
bool sweep(const hearth::cell_graph<>& graph, field& solid_fraction, std::vector<bool>& smoothed) {
    std::vector<std::size_t> over_full;
    for (std::size_t cell = 0; cell < solid_fraction.size(); ++cell) {
        if (solid_fraction[cell] > threshold && !smoothed[cell]) over_full.push_back(cell);
    }
    for (const std::size_t cell : over_full) smoothed[cell] = true;
    for (const std::size_t cell : over_full) {
        std::vector<std::size_t> receivers;
        graph.for_each_neighbour(static_cast<int>(cell), [&](int n) {
            if (!smoothed[static_cast<std::size_t>(n)]) receivers.push_back(static_cast<std::size_t>(n));
        });
        for (const std::size_t n : receivers) {
            solid_fraction[n] += (solid_fraction[cell] - threshold) / static_cast<double>(receivers.size());
        }
        solid_fraction[cell] = threshold;
    }
    return !over_full.empty();
}

/// A drawing of a lattice, one layer thick, and the spheres in it.
class picture {
  public:
    picture(const hearth::lattice& mesh, std::vector<hearth::point> centres, double radius)
        : mesh_(mesh), centres_(std::move(centres)), radius_(radius) {}

    /// Adds a panel: white for empty, blue for full, orange with its number for more than the threshold.
    void add(const std::string& title, const field& solid_fraction) {
        const double left = 20 + (panels_ % 2) * (mesh_.cells[0] * size + 30);
        const double top = 40 + (panels_ / 2) * (mesh_.cells[1] * size + 50);
        ++panels_;
        std::string cells, numbers;
        for (std::size_t cell = 0; cell < solid_fraction.size(); ++cell) {
            const auto row_length = static_cast<std::size_t>(mesh_.cells[0]);
            const double x = left + size * static_cast<double>(cell % row_length);
            const double y = top + size * static_cast<double>(cell / row_length);
            const double value = solid_fraction[cell];
            const bool over_full = value > threshold;
            cells += print("<rect x='%g' y='%g' width='%g' height='%g' stroke='#888' ", x, y, size, size);
            cells += print("fill='%s' fill-opacity='%.2f'/>\n", over_full ? "#E69F00" : "#0072B2",
                           over_full ? 1.0 : 0.8 * value / threshold);
            if (value > 0) {
                numbers += print("<text x='%g' y='%g' font-size='11' text-anchor='middle'>%.2f</text>\n", x + size / 2,
                                 y + size / 2 + 4, value);
            }
        }
        text_ += print("<text x='%g' y='%g' font-size='16'>", left, top - 10) + title + "</text>\n" + cells;
        for (const hearth::point& centre : centres_) {
            text_ += print("<circle cx='%g' cy='%g' r='%g' fill='none' stroke='#666' stroke-width='1.5'/>\n",
                           left + size * centre[0] / mesh_.spacing[0], top + size * centre[1] / mesh_.spacing[1],
                           size * radius_ / mesh_.spacing[0]);
        }
        text_ += numbers;
    }

    void write(const char* file) const {
        const double width = 40 + 2 * mesh_.cells[0] * size + 30, height = 10 + 2 * (mesh_.cells[1] * size + 50);
        std::FILE* out = std::fopen(file, "w");
        std::fprintf(out, "<svg xmlns='http://www.w3.org/2000/svg' width='%g' height='%g' font-family='sans-serif'>\n",
                     width, height);
        std::fprintf(out, "<rect width='100%%' height='100%%' fill='white'/>\n%s</svg>\n", text_.c_str());
        std::fclose(out);
    }

  private:
    static constexpr double size = 34;  // of a cell in the drawing

    template <class... Values>
    static std::string print(const char* format, Values... values) {
        char line[160];
        std::snprintf(line, sizeof line, format, values...);
        return line;
    }

    hearth::lattice mesh_;
    std::vector<hearth::point> centres_;
    double radius_;
    std::string text_;
    int panels_ = 0;
};

int main() {
    // One layer of cells, as thick as a sphere is on the average over its shadow, so that a cell is full where the
    // drawing shows it covered.
    const double radius = 1.7;
    hearth::lattice mesh;
    mesh.cells = {11, 8, 1};
    mesh.spacing = {1, 1, 4.0 / 3.0 * radius};
    const std::vector<hearth::point> centres{{3.5, 3.5, radius}, {6.7, 4.6, radius}};

    hearth::strided_cloud<> particles;
    particles.count = 2;
    particles.position = {centres.front().data(), 3};
    particles.radius = {&radius, 0};

    const hearth::cell_graph graph(mesh);
    const hearth::cell_locator locator(mesh, graph);
    field deposited(static_cast<std::size_t>(graph.cell_count()));
    const auto deposit = hearth::deposit_solid_fraction(locator, particles, deposited, hearth::deposit::centre{});

    picture drawing(mesh, centres, radius);
    drawing.add("(a) all volume to the cells of the centres", deposited);
    field plain = deposited;
    std::vector<bool> smoothed(plain.size());
    sweep(graph, plain, smoothed);
    drawing.add("(b) after the first sweep", plain);
    sweep(graph, plain, smoothed);
    drawing.add("(c) after the second sweep", plain);
    while (sweep(graph, plain, smoothed)) continue;

    field solid_fraction = deposited;
    const hearth::vfs_report report = hearth::smooth_volume_fraction(mesh, solid_fraction, {threshold});
    drawing.add("(d) no cell above the threshold of 0.9", solid_fraction);
    drawing.write("02_smooth_a_lattice.svg");

    double difference = 0, solid = 0;
    for (std::size_t cell = 0; cell < plain.size(); ++cell) {
        difference = std::fmax(difference, std::abs(plain[cell] - solid_fraction[cell]));
        solid += solid_fraction[cell] * graph.volume(static_cast<int>(cell));
    }
    const double lost = solid / deposit.solid_volume - 1;
    std::printf("%d sweeps, largest fraction %g, volume off by %.0e, against the plain sweeps %.0e\n", report.sweeps,
                report.maximum, lost, difference);
    // 88 cells, each with a few roundings of numbers up to 9.
    return report.maximum <= threshold && std::abs(lost) < 1e-14 && difference < 1e-14 ? 0 : 1;
}
