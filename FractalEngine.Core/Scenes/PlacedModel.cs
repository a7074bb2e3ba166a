using System.Runtime.CompilerServices;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes;

/// <summary>An object of a scene together with its model and its place in the world.</summary>
/// <param name="declaration">What the scene says of the object.</param>
/// <param name="model">Shared by all objects of the same file.</param>
public sealed class PlacedModel(SceneObject declaration, Model model)
{
    // It is an object of a class, so that it is set in one write. Computed twice at worst, with the same result.
    private StrongBox<BoundingBox>? _bounds;

    /// <summary>Places the model of an object.</summary>
    /// <param name="declaration">With its model.</param>
    /// <exception cref="FractalEngineException">The object names a file that is not loaded.</exception>
    public PlacedModel(SceneObject declaration)
        : this(declaration, declaration.Model ?? throw new FractalEngineException(
            $"the object '{declaration.DisplayName}' has no model: load its scene with AssetLoader, or give it a model"))
    {
    }

    /// <summary>The object as the scene declares it.</summary>
    public SceneObject Declaration { get; } = declaration;

    /// <summary>Mesh or fractal that the object shows, in its own coordinate frame.</summary>
    public Model Model { get; } = model;

    /// <summary>
    /// How the instances differ in colour: as the object says, or else as the file of its fractal does, unless the object has a colour.
    /// Null for not at all.
    /// </summary>
    public Gradient? Gradient =>
        Declaration.Gradient ?? (Declaration.Colour is null && Model is FractalModel fractal ? fractal.Gradient : null);

    /// <summary>The gradient where instances show it: those of a fractal of affine composition without materials; null for none.</summary>
    public Gradient? ShownGradient => Gradient is { Kind: not GradientKind.None } gradient && Model.Materials.IsEmpty
        && Model is FractalModel { Fractal.Description.Composition: Composition.Affine } ? gradient : null;

    /// <summary>Whether instances differ in colour, by their maps or by a gradient.</summary>
    public bool HasTints => Model is FractalModel { Fractal.HasColours: true } || ShownGradient is not null;

    /// <summary>Maps the model's frame to world space: the paper's global matrix m.</summary>
    public AffineMap ObjectToWorld { get; internal init; } = declaration.Placement.ToAffineMap();

    /// <summary>The object by the parts of its model, see <see cref="Model.Parts"/>.</summary>
    public IEnumerable<PlacedModel> Parts =>
        Model.Parts is [var only] && ReferenceEquals(only, Model) ? [this] : Model.Parts.Select(
            part => new PlacedModel(Declaration, part) { ObjectToWorld = ObjectToWorld });

    /// <summary>A box that holds the object in world space; as tight as the model's own.</summary>
    public BoundingBox Bounds => (_bounds ??= new(ComputeWorldBounds(Declaration, ObjectToWorld, Model))).Value;

    /// <summary>Builds the collider of the object in world space, whatever its matrix.</summary>
    /// <param name="kind">How to search; exact unless stated.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such kind.</exception>
    /// <exception cref="ColliderMismatchException">The kind does not fit the model; the message says which kinds do.</exception>
    /// <exception cref="FractalLimitException">The fractal is too large for this kind, or grows beyond a double.</exception>
    public Collider CreateCollider(ColliderKind kind = ColliderKind.Exact)
    {
        ColliderFactory.ThrowIfUnknown(kind);
        return Model switch
        {
            FractalModel { Fractal: { Description.Composition: Composition.Affine } fractal } =>
                Collider.For(fractal.WithPlacement(Declaration.Placement), kind),
            FractalModel { Fractal: var fractal } => ColliderFactory.CreateExpanded(fractal, ObjectToWorld, kind),
            _ => Collider.For(FractalGenerator.Flatten(Model.Mesh, [ObjectToWorld]), kind),
        };
    }

    private static BoundingBox ComputeWorldBounds(SceneObject declaration, AffineMap objectToWorld, Model model) => model switch
    {
        FractalModel { Fractal: { Description.Composition: Composition.Affine } fractal }
            when objectToWorld == declaration.Placement.ToAffineMap() => fractal.WithPlacement(declaration.Placement).Bounds,
        MeshModel => model.Mesh.ComputeBounds(objectToWorld),
        _ => model.Bounds.Transform(objectToWorld),
    };
}
