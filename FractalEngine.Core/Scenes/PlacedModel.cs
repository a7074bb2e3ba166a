using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes;

/// <summary>An object of a scene together with the model that its file holds.</summary>
public sealed class PlacedModel
{
    private readonly Lazy<BoundingBox> _bounds;

    /// <summary>An object and its model.</summary>
    /// <param name="declaration">What the scene says of it.</param>
    /// <param name="model">Shared by all objects of the same file.</param>
    public PlacedModel(SceneObject declaration, Model model)
    {
        (Declaration, Model, ObjectToWorld) = (declaration, model, declaration.Placement.ToAffineMap());
        _bounds = new(() => ComputeWorldBounds(declaration, ObjectToWorld, model));
    }

    /// <summary>What the scene says of the object.</summary>
    public SceneObject Declaration { get; }

    /// <summary>What the object's file holds.</summary>
    public Model Model { get; }

    /// <summary>From the model's frame to world space: the paper's global matrix m.</summary>
    public AffineMap ObjectToWorld { get; }

    /// <summary>A box that holds the object in world space; as tight as the model's own.</summary>
    public BoundingBox Bounds => _bounds.Value;

    private static BoundingBox ComputeWorldBounds(SceneObject declaration, AffineMap objectToWorld, Model model) => model switch
    {
        FractalModel { Fractal: { Description.Composition: Composition.Affine } fractal } =>
            FractalBounds.ComputeBox(new(fractal.Description.WithPlacement(declaration.Placement), fractal.BaseMesh)),
        MeshModel => ComputeWorldBounds(objectToWorld, model.Mesh),
        _ => model.Bounds.Transform(objectToWorld),
    };

    private static BoundingBox ComputeWorldBounds(AffineMap objectToWorld, Mesh mesh)
    {
        var box = BoundingBox.Empty;
        for (var vertex = 0; vertex < mesh.VertexCount; vertex++)
        {
            box = box.Including(objectToWorld * mesh.Vertex(vertex));
        }

        return box;
    }
}
