using System.Collections.Immutable;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Scenes;

/// <summary>A scene with everything that its files hold.</summary>
/// <param name="Scene">What the scene file says.</param>
/// <param name="Objects">In the order of <see cref="Scene.Objects"/>.</param>
public sealed record LoadedScene(Scene Scene, ImmutableArray<PlacedModel> Objects)
{
    /// <summary>A box that holds all objects in world space.</summary>
    public BoundingBox Bounds { get; } =
        Objects.Aggregate(BoundingBox.Empty, (box, placed) => BoundingBox.Union(box, placed.Bounds));

    /// <summary>The models, each file once, in the order of their first use.</summary>
    public IEnumerable<Model> Models => Objects.Select(placed => placed.Model).Distinct();

    /// <summary>The models of the objects that no physics moves, each file once.</summary>
    public IEnumerable<Model> StaticModels =>
        Objects.Where(static placed => placed.Declaration is not PhysicsObject).Select(static placed => placed.Model).Distinct();
}
