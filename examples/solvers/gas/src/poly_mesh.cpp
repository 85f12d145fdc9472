// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>

#include <hearth/gas/poly_mesh.hpp>

namespace hearth::gas {

namespace {

/// Tokens of an OpenFOAM file: words, numbers, quoted strings, single punctuation; comments are skipped.
class foam_file {
  public:
    explicit foam_file(const std::string& path) : path_(path) {
        std::ifstream in(path, std::ios::binary);
        if (!in) throw file_error(path, 0, "cannot be opened");
        std::ostringstream all;
        all << in.rdbuf();
        text_ = all.str();
        if (text_.size() > 1 && text_[0] == '\x1f' && text_[1] == '\x8b')
            throw file_error(path, 0, "is compressed; unpack it first");
        read_header();
    }

    [[noreturn]] void fail(const std::string& what) const {
        const auto end = text_.begin() + static_cast<std::ptrdiff_t>(std::min(at_, text_.size()));
        throw file_error(path_, 1 + static_cast<long>(std::count(text_.begin(), end, '\n')), what);
    }

    std::string next() {
        skip_space();
        if (at_ >= text_.size()) fail("ends too early");
        const std::size_t begin = at_;
        if (std::strchr("(){};", text_[at_])) return text_.substr(at_++, 1);
        if (text_[at_] == '"') {
            const std::size_t end = text_.find('"', at_ + 1);
            if (end == std::string::npos) fail("a string does not end");
            at_ = end + 1;
            return text_.substr(begin + 1, end - begin - 1);
        }
        while (at_ < text_.size() && !std::isspace(static_cast<unsigned char>(text_[at_])) &&
               !std::strchr("(){};\"", text_[at_]))
            ++at_;
        return text_.substr(begin, at_ - begin);
    }
    void expect(const char* token) {
        const std::string found = next();
        if (found != token) fail("expected '" + std::string(token) + "', found '" + found + "'");
    }

    double number() {
        const std::string token = next();
        char* end = nullptr;
        const double value = std::strtod(token.c_str(), &end);
        if (token.empty() || *end != 0) fail("expected a number, found '" + token + "'");
        return value;
    }
    int label() {
        const double value = number();
        if (value != static_cast<double>(static_cast<std::int64_t>(value))) fail("expected a whole number");
        return narrow(static_cast<std::int64_t>(value));
    }
    int count() {
        const int n = label();
        if (n < 0) fail("a list cannot have " + std::to_string(n) + " entries");
        // every entry takes a byte or more: a damaged count must not ask for all memory
        if (static_cast<std::size_t>(n) > text_.size()) fail("a list of " + std::to_string(n) + " entries does not fit the file");
        return n;
    }

    /// A list of labels: n ( ... ), n { value }, or binary.
    array<int> labels() {
        const int n = count();
        array<int> out(n);
        skip_space();
        if (at_ < text_.size() && text_[at_] == '{') {
            ++at_;
            std::fill(out.begin(), out.end(), label());
            expect("}");
            return out;
        }
        if (binary_) {
            if (n > 0) raw(n, label_size_, [&](const char* from, int i) { out[i] = binary_label(from); });
            else expect_empty();
            return out;
        }
        expect("(");
        for (int& v : out) v = label();
        expect(")");
        return out;
    }
    array<vector3> vectors() {
        const int n = count();
        array<vector3> out(n);
        if (binary_) {
            if (n > 0)
                raw(n, 3 * scalar_size_, [&](const char* from, int i) {
                    for (int k = 0; k < 3; ++k) out[i][k] = binary_scalar(from + k * scalar_size_);
                });
            else expect_empty();
            return out;
        }
        expect("(");
        for (vector3& v : out) {
            expect("(");
            for (int k = 0; k < 3; ++k) v[k] = number();
            expect(")");
        }
        expect(")");
        return out;
    }
    bool binary() const { return binary_; }
    const std::string& kind() const { return kind_; }

  private:
    void skip_space() {
        while (at_ < text_.size()) {
            if (std::isspace(static_cast<unsigned char>(text_[at_]))) {
                ++at_;
            } else if (text_.compare(at_, 2, "//") == 0) {
                at_ = std::min(text_.find('\n', at_), text_.size());
            } else if (text_.compare(at_, 2, "/*") == 0) {
                const std::size_t end = text_.find("*/", at_ + 2);
                if (end == std::string::npos) fail("a comment does not end");
                at_ = end + 2;
            } else {
                return;
            }
        }
    }
    void read_header() {
        expect("FoamFile");
        expect("{");
        for (std::string key = next(); key != "}"; key = next()) {
            std::string value = next();
            if (key == "format") binary_ = value == "binary";
            if (key == "class") kind_ = value;
            if (key == "arch") {
                if (value.find("MSB") != std::string::npos) fail("is big-endian");
                label_size_ = value.find("label=64") != std::string::npos ? 8 : 4;
                scalar_size_ = value.find("scalar=32") != std::string::npos ? 4 : 8;
            }
            while (value != ";") value = next();
        }
    }
    void expect_empty() {
        skip_space();
        if (at_ < text_.size() && text_[at_] == '(') {
            expect("(");
            expect(")");
        }
    }
    template <class Take>
    void raw(int n, int size, Take&& take) {
        expect("(");  // the bytes begin right behind it
        const std::size_t bytes = static_cast<std::size_t>(n) * static_cast<std::size_t>(size);
        if (at_ + bytes > text_.size()) fail("the binary list is cut off");
        for (int i = 0; i < n; ++i) take(text_.data() + at_ + static_cast<std::size_t>(i) * static_cast<std::size_t>(size), i);
        at_ += bytes;
        expect(")");
    }
    int narrow(std::int64_t v) const {
        if (v < std::numeric_limits<int>::min() || v > std::numeric_limits<int>::max())
            fail("the label " + std::to_string(v) + " is too large");
        return static_cast<int>(v);
    }
    int binary_label(const char* from) const {
        std::int32_t small = 0;
        std::int64_t large = 0;
        if (label_size_ == 4) std::memcpy(&small, from, 4);
        else std::memcpy(&large, from, 8);
        return label_size_ == 4 ? small : narrow(large);
    }
    double binary_scalar(const char* from) const {
        float small = 0;
        double large = 0;
        if (scalar_size_ == 4) std::memcpy(&small, from, 4);
        else std::memcpy(&large, from, 8);
        return scalar_size_ == 4 ? static_cast<double>(small) : large;
    }

    std::string path_, text_, kind_;
    std::size_t at_ = 0;
    bool binary_ = false;
    int label_size_ = 4, scalar_size_ = 8;
};

void read_faces(foam_file& file, polyhedra& out) {
    if (file.kind() == "faceCompactList") {  // offsets and points, as binary writers do
        out.face_first = file.labels();
        out.face_points = file.labels();
        if (out.face_first.empty() || out.face_first.back() != static_cast<int>(out.face_points.size()))
            file.fail("the offsets of the faces do not end at the number of points");
        for (std::size_t i = 1; i < out.face_first.size(); ++i)
            if (out.face_first[i] < out.face_first[i - 1]) file.fail("the offsets of the faces fall");
        return;
    }
    if (file.binary()) file.fail("a binary list of faces must be a faceCompactList, found '" + file.kind() + "'");
    const int n = file.count();
    file.expect("(");
    out.face_first = {0};
    for (int f = 0; f < n; ++f) {
        const int size = file.count();
        file.expect("(");
        for (int i = 0; i < size; ++i) out.face_points.push_back(file.label());
        file.expect(")");
        out.face_first.push_back(static_cast<int>(out.face_points.size()));
    }
    file.expect(")");
}

void read_boundary(foam_file& file, polyhedra& out) {
    const int n = file.count();
    file.expect("(");
    for (int i = 0; i < n; ++i) {
        patch p;
        p.name = file.next();
        p.first = p.count = -1;
        file.expect("{");
        for (std::string key = file.next(); key != "}"; key = file.next()) {
            if (key == "nFaces") p.count = file.label();
            else if (key == "startFace") p.first = file.label();
            std::string value = ";";
            do value = file.next();
            while (value != ";");
        }
        if (p.first < 0 || p.count < 0) file.fail("patch '" + p.name + "' lacks nFaces or startFace");
        out.patches.push_back(p);
    }
    file.expect(")");
}

}  // namespace

polyhedra read_poly_mesh(const std::string& folder) {
    polyhedra out;
    out.points = foam_file(folder + "/points").vectors();
    foam_file faces(folder + "/faces");
    read_faces(faces, out);
    out.owner = foam_file(folder + "/owner").labels();
    foam_file neighbour(folder + "/neighbour");
    out.neighbour = neighbour.labels();
    if (out.neighbour.size() == out.owner.size()) {  // old files pad it with -1
        const auto end = std::find(out.neighbour.begin(), out.neighbour.end(), -1);
        out.neighbour.erase(end, out.neighbour.end());
    }
    foam_file boundary(folder + "/boundary");
    read_boundary(boundary, out);
    return out;
}

}  // namespace hearth::gas
