using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Physics.Descriptions;

/// <summary>
/// A rigid body whose surface is a mesh, or all instances of a finite fractal, and how its mass is spread. Immutable, and for any number of
/// bodies: those of the same model share its hierarchy.
/// </summary>
public sealed class MeshShape
{
    // Relative to the diagonal: the least thickness of the box that has the mass of a shape without volume.
    private const double MinThickness = 0.01;

    /// <summary>Makes the shape of a model.</summary>
    /// <param name="model">A mesh, or a fractal with finitely many levels.</param>
    /// <param name="linear">Rotation and scale from the model's frame to the axes of the world; null for none.</param>
    /// <exception cref="ArgumentException">The model is empty or infinite, or has no finite mass; the message says which.</exception>
    public MeshShape(Model model, Matrix? linear = null)
    {
        ArgumentNullException.ThrowIfNull(model);
        Model = model;
        Linear = linear ?? Matrix.Identity;
        var map = new AffineMap(Linear, Vector.Zero);
        ArgumentCheck.Require(
            model is not FractalModel { Fractal.Description.IsInfinite: true }, "a body needs a fractal with a finite depth");
        var fractal = (model as FractalModel)?.Fractal;
        ArgumentCheck.Require(
            fractal is not { Description.Composition: not Composition.Affine }, "a body needs a fractal with affine composition");
        ArgumentCheck.Require(!model.Bounds.IsEmpty && model.FaceCount > 0, "a body needs a face");
        var isClosed = false;
        var mass = fractal is null
            ? MassProperties.Of(model.Mesh, out isClosed)
            : MassProperties.Of(fractal.Hierarchy, out isClosed) ?? default;
        HasMassOfSurface = isClosed && mass.IsSolidWithin(model.Bounds);
        mass = (mass.IsSolidWithin(model.Bounds) ? mass : OfBox(model.Bounds)).Transform(in map);
        Volume = mass.Volume;
        Centre = mass.Centre;
        Inertia = mass.Inertia;
        var isFinite = Volume > 0 && double.IsFinite(Volume) && Centre.IsFinite() && Inertia.IsFinite();
        ArgumentCheck.Require(isFinite, "the mass is beyond the range of a double");
        Radius = BodyRadius.MaxCornerDistance(model.Bounds, in map, Centre);
    }

    /// <summary>The mesh or fractal that is the body's surface.</summary>
    public Model Model { get; }

    /// <summary>Rotation and scale from the model's frame to the axes of the world, before the body turns.</summary>
    public Matrix Linear { get; }

    /// <summary>Volume in cubic scene units: the sum over all instances, so that what overlaps counts twice.</summary>
    public double Volume { get; }

    /// <summary>True where the volume is that of closed meshes; false where it is that of hulls, or of the box of what is flat.</summary>
    public bool HasMassOfSurface { get; }

    /// <summary>The centre of mass relative to the object's position, in the axes of the world, scene units.</summary>
    public Vector Centre { get; }

    /// <summary>Inertia tensor of one kilogram about the centre of mass, scene units².</summary>
    public Matrix Inertia { get; }

    /// <summary>Radius of a sphere about the centre of mass that holds the shape, scene units.</summary>
    public double Radius { get; }

    private static MassProperties OfBox(BoundingBox box)
    {
        var size = Vector.Max(box.Size, MinThickness * box.Diagonal * Vector.One);
        var solid = Shapes.Box(new(box.Centre - (0.5 * size), box.Centre + (0.5 * size)));
        return MassProperties.Of(Enumerable.Range(0, solid.FaceCount).Select(solid.Face), box.Centre);
    }
}
