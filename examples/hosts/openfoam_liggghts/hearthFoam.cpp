// SPDX-License-Identifier: MIT
// A gas solver of OpenFOAM and the spheres of LIGGGHTS in one MPI job, coupled by hearth: void fraction, drag and
// pressure, heat, Time Scale Splitting.  In a case folder, on any number of ranks:
//
//     hearthFoam                    mpirun -np 2 hearthFoam -parallel
//
// The gas is of constant properties and pays e grad p (model A); the spheres pay the rest.  Its settings are in
// constant/coupling, the script of LIGGGHTS too; tests/hosts/openfoam_liggghts has two cases.
//
// Linked with OpenFOAM and LIGGGHTS, so the program is under the GPL; this file is not.
#include "spheres.hpp"

#include <exception>

namespace {

template <class Type>
GeometricField<Type, fvPatchField, volMesh> read_field(const char* name, const fvMesh& mesh) {
    return {IOobject(name, mesh.time().timeName(), mesh, IOobject::MUST_READ, IOobject::AUTO_WRITE), mesh};
}

/// A field of one time step; it has no boundary values of its own.
template <class Type>
GeometricField<Type, fvPatchField, volMesh> made_field(const char* name, const fvMesh& mesh, const dimensionSet& unit) {
    return {IOobject(name, mesh.time().timeName(), mesh), mesh, dimensioned<Type>(unit, Zero), "zeroGradient"};
}

void solve(Time& time, const fvMesh& mesh) {
    const IOdictionary settings(IOobject("coupling", time.constant(), mesh, IOobject::MUST_READ));
    const dictionary& gas = settings.subDict("gas");
    const dimensionedScalar rho("rho", dimDensity, gas), viscosity("viscosity", dimDynamicViscosity, gas);
    const dimensionedScalar heat_capacity("specificHeat", dimSpecificHeatCapacity, gas);
    const dimensionedScalar conductivity("conductivity", dimPower / dimLength / dimTemperature, gas);
    spheres bed(mesh, settings.subDict("spheres"),
                {{}, viscosity.value(), conductivity.value(), heat_capacity.value(), {}, {}, {}, {}, {}},
                rho.value(), settings.get<vector>("gravity"));

    volVectorField U = read_field<vector>("U", mesh);  // interstitial
    volScalarField p = read_field<scalar>("p", mesh);  // over rho, less its static part
    volScalarField T = read_field<scalar>("T", mesh), e = read_field<scalar>("voidFraction", mesh);
    mesh.setFluxRequired(p.name());
    bed.place(e);
    surfaceScalarField phi("phi", fvc::interpolate(e) * fvc::flux(U));
    const dimensionSet force_unit = dimForce / dimVolume, heat_unit = dimPower / dimVolume;
    volScalarField drag = made_field<scalar>("drag", mesh, force_unit / dimVelocity),
                   exchange = made_field<scalar>("exchange", mesh, heat_unit / dimTemperature);
    volVectorField force = made_field<vector>("force", mesh, force_unit);
    volScalarField heat = made_field<scalar>("heat", mesh, heat_unit);

    while (time.loop()) {
        const scalar step = time.deltaTValue(), storage = bed.clock().gas_storage_factor();
        Info << "Time = " << time.timeName() << nl;
        bed.place(e);
        const volScalarField filling("filling", fvc::ddt(e));

        bed.drag(U, drag.primitiveFieldRef(), force.primitiveFieldRef());
        fvVectorMatrix UEqn(fvm::ddt(e, U) - fvm::Sp(filling, U) + fvm::div(phi, U) - fvm::Sp(fvc::div(phi), U) -
                            fvm::laplacian(e * viscosity / rho, U) + fvm::Sp(drag / rho, U) - force / rho);
        const volScalarField rAU("rAU", 1 / UEqn.A());
        const surfaceScalarField e_faces("eFaces", fvc::interpolate(e));
        for (int corrector = 0; corrector < 2; ++corrector) {
            const volVectorField HbyA(constrainHbyA(rAU * UEqn.H(), U, p));
            const surfaceScalarField predicted("predicted", e_faces * fvc::flux(HbyA));
            fvScalarMatrix pEqn(fvm::laplacian(e_faces * fvc::interpolate(rAU * e), p) ==
                                fvc::div(predicted) + storage * filling);
            pEqn.setReference(Pstream::master() ? 0 : -1, 0);
            pEqn.solve();
            phi = predicted - pEqn.flux();
            U = HbyA - rAU * e * fvc::grad(p);
            U.correctBoundaryConditions();
        }
        const volVectorField gradient("gradient", rho * fvc::grad(p));
        bed.push(U, gradient, step);
        bed.book(vectorField((force.primitiveField() - drag.primitiveField() * U.primitiveField()) * mesh.V()),
                 vectorField((e.primitiveField() - 1) * gradient.primitiveField() * mesh.V()), step);

        bed.heat(T, step, exchange.primitiveFieldRef(), heat.primitiveFieldRef());
        fvScalarMatrix TEqn(
            rho * heat_capacity *
                (storage * (fvm::ddt(e, T) - fvm::Sp(filling, T)) + fvm::div(phi, T) - fvm::Sp(fvc::div(phi), T)) -
            fvm::laplacian(e * conductivity, T) + fvm::Sp(exchange, T) - heat);
        TEqn.solve();
        bed.warm(
            T, scalarField((exchange.primitiveField() * T.primitiveField() - heat.primitiveField()) * mesh.V() * step));

        bed.move(step);
        const auto off = bed.imbalance();
        Info << "hearth: off by, drag " << off[0] << " pressure " << off[1] << " heat " << off[2] << "; from walls "
             << off[3] << endl;
        time.write();
        if (time.writeTime()) bed.write(time.timePath() / "spheres");
    }
}

}  // namespace

int main(int argc, char* argv[]) {
#include "setRootCase.H"
    if (!Pstream::parRun()) Pstream::initNull();  // OpenFOAM starts MPI only where it is -parallel; LIGGGHTS needs it
#include "createTime.H"
#include "createMesh.H"
    try {
        solve(runTime, mesh);
    } catch (const std::exception& error) {  // on all ranks alike
        FatalErrorInFunction << error.what() << Foam::exit(FatalError);
    }
    return 0;
}
