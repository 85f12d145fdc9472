// SPDX-License-Identifier: MIT
#include <hearth/gas/mpi_ranks.hpp>

#include <stdexcept>
#include <string>

#include <HYPRE.h>
#include <HYPRE_IJ_mv.h>
#include <HYPRE_parcsr_ls.h>
#include <HYPRE_parcsr_mv.h>

namespace hearth::gas {

namespace {

void require(HYPRE_Int error, const char* what) {
    if (error == 0) return;
    HYPRE_ClearAllErrors();
    throw std::runtime_error("hearth::gas: hypre: error " + std::to_string(error) + " in " + what);
}

class boomer_amg final : public preconditioner {
  public:
    boomer_amg(const pattern& p, const parallel& ranks, MPI_Comm communicator) : shape_(&p), communicator_(communicator) {
        HYPRE_Init();
        // rows are numbered rank by rank
        array<double> cells(ranks.ranks(), 0.0), number(p.columns);
        cells[ranks.rank()] = p.rows;
        ranks.sum(cells.data(), cells.count());
        double first = 0;
        for (int r = 0; r < ranks.rank(); ++r) first += cells[r];
        for (int c = 0; c < p.rows; ++c) number[c] = first + c;
        ranks.gather(number.data(), 1);
        number_.reserve(p.columns);
        for (const double n : number) number_.push_back(static_cast<HYPRE_BigInt>(n));
        for (auto* v : {&residual_, &correction_}) {
            require(HYPRE_IJVectorCreate(communicator_, number_[0], number_[p.rows - 1], v), "IJVectorCreate");
            require(HYPRE_IJVectorSetObjectType(*v, HYPRE_PARCSR), "IJVectorSetObjectType");
        }
    }
    boomer_amg(const boomer_amg&) = delete;
    boomer_amg& operator=(const boomer_amg&) = delete;
    ~boomer_amg() override {
        forget();
        HYPRE_IJVectorDestroy(residual_);
        HYPRE_IJVectorDestroy(correction_);
    }

    void rebuild() override { forget(); }

    /// Keeps all levels, the finest too, until rebuild(): the matrices of successive iterations are near enough.
    void update(const matrix& a) override {
        if (amg_) return;
        const pattern& p = *shape_;
        require(HYPRE_IJMatrixCreate(communicator_, number_[0], number_[p.rows - 1], number_[0], number_[p.rows - 1],
                                     &matrix_), "IJMatrixCreate");
        require(HYPRE_IJMatrixSetObjectType(matrix_, HYPRE_PARCSR), "IJMatrixSetObjectType");
        array<HYPRE_Int> width(p.rows);
        for (int c = 0; c < p.rows; ++c) width[c] = p.first[c + 1] - p.first[c] + 1;
        require(HYPRE_IJMatrixSetRowSizes(matrix_, width.data()), "IJMatrixSetRowSizes");
        require(HYPRE_IJMatrixInitialize(matrix_), "IJMatrixInitialize");
        array<HYPRE_BigInt> columns;
        array<double> values;
        for (int c = 0; c < p.rows; ++c) {
            columns.assign(1, number_[c]);
            values.assign(1, a.diagonal[c]);
            for (int i = p.first[c]; i < p.first[c + 1]; ++i) {
                columns.push_back(number_[p.column[i]]);
                values.push_back(a.entry[i]);
            }
            require(HYPRE_IJMatrixSetValues(matrix_, 1, &width[c], &number_[c], columns.data(), values.data()),
                    "IJMatrixSetValues");
        }
        require(HYPRE_IJMatrixAssemble(matrix_), "IJMatrixAssemble");
        require(HYPRE_BoomerAMGCreate(&amg_), "BoomerAMGCreate");
        HYPRE_BoomerAMGSetMaxIter(amg_, 1);
        HYPRE_BoomerAMGSetTol(amg_, 0);
        HYPRE_BoomerAMGSetCoarsenType(amg_, 10);         // HMIS
        HYPRE_BoomerAMGSetInterpType(amg_, 6);           // extended+i
        HYPRE_BoomerAMGSetPMaxElmts(amg_, 4);
        HYPRE_BoomerAMGSetAggNumLevels(amg_, 1);         // aggressive on the finest level: less memory and time
        HYPRE_BoomerAMGSetStrongThreshold(amg_, 0.25);
        HYPRE_BoomerAMGSetRelaxType(amg_, 8);            // symmetric Gauss-Seidel, l1-scaled between ranks
        HYPRE_BoomerAMGSetNumSweeps(amg_, 1);
        set(residual_, nullptr);
        set(correction_, nullptr);
        require(HYPRE_BoomerAMGSetup(amg_, par_matrix(), par_vector(residual_), par_vector(correction_)), "BoomerAMGSetup");
    }

    void apply(const double* residual, double* correction) override {
        set(residual_, residual);
        set(correction_, nullptr);
        require(HYPRE_BoomerAMGSolve(amg_, par_matrix(), par_vector(residual_), par_vector(correction_)), "BoomerAMGSolve");
        require(HYPRE_IJVectorGetValues(correction_, shape_->rows, number_.data(), correction), "IJVectorGetValues");
    }

  private:
    static HYPRE_ParVector par_vector(HYPRE_IJVector v) {
        void* found = nullptr;
        require(HYPRE_IJVectorGetObject(v, &found), "IJVectorGetObject");
        return static_cast<HYPRE_ParVector>(found);
    }
    HYPRE_ParCSRMatrix par_matrix() const {
        void* found = nullptr;
        require(HYPRE_IJMatrixGetObject(matrix_, &found), "IJMatrixGetObject");
        return static_cast<HYPRE_ParCSRMatrix>(found);
    }
    /// Null: zero.
    void set(HYPRE_IJVector v, const double* values) {
        require(HYPRE_IJVectorInitialize(v), "IJVectorInitialize");
        if (values) require(HYPRE_IJVectorSetValues(v, shape_->rows, number_.data(), values), "IJVectorSetValues");
        require(HYPRE_IJVectorAssemble(v), "IJVectorAssemble");
        if (!values) require(HYPRE_ParVectorSetConstantValues(par_vector(v), 0), "ParVectorSetConstantValues");
    }
    void forget() {
        if (amg_) HYPRE_BoomerAMGDestroy(amg_);
        if (matrix_) HYPRE_IJMatrixDestroy(matrix_);
        amg_ = nullptr;
        matrix_ = nullptr;
    }

    const pattern* shape_;
    MPI_Comm communicator_;
    array<HYPRE_BigInt> number_;  // per cell with ghosts: row in the matrix of all ranks
    HYPRE_IJMatrix matrix_ = nullptr;
    HYPRE_IJVector residual_ = nullptr, correction_ = nullptr;
    HYPRE_Solver amg_ = nullptr;
};

}  // namespace

bool has_hypre() { return true; }

std::unique_ptr<preconditioner> make_boomer_amg(const pattern& p, const parallel& ranks, MPI_Comm communicator) {
    return std::make_unique<boomer_amg>(p, ranks, communicator);
}

}  // namespace hearth::gas
