using System.Collections.Immutable;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Visibility.Levels;

namespace FractalEngine.Core.Views;

/// <summary>
/// Finds points on the outside of a scene, which a camera frames. They are vertices of meshes, and corners of small boxes around the parts
/// of fractals. Of the points in about the same direction from the scene's centre, only the farthest one is kept.
/// </summary>
internal sealed class FramingPoints(Vector centre)
{
    // Directions are told apart by their cell on a cube with so many cells along an edge: less than 4° each.
    private const int CellsPerEdge = 24;

    // Boxes of a fractal. With 2,000, that of a sponge is a ninth of it, and that of a tree a leaf.
    private const int MaxBoxes = 2000;

    // More vertices would take longer than a frame. The boxes of objects must do then.
    private const long MaxVertices = 3_000_000;

    private readonly (double DistanceSquared, Vector Point)[] _farthest = new (double, Vector)[6 * CellsPerEdge * CellsPerEdge];

    /// <summary>Collects the points of a scene.</summary>
    /// <returns>World space; none for a scene without faces, or with infinite bounds.</returns>
    public static ImmutableArray<Vector> Collect(LoadedScene scene)
    {
        if (scene.Bounds.IsEmpty || !scene.Bounds.Size.IsFinite())
        {
            return [];
        }

        var points = new FramingPoints(scene.Bounds.Centre);
        var usesBoxes = scene.Objects.SelectMany(static placed => placed.Model.Parts).Sum(
            static part => (long)part.Mesh.VertexCount) > MaxVertices;
        foreach (var placed in scene.Objects)
        {
            if (usesBoxes || !points.TryAdd(placed))
            {
                points.AddCorners(placed.Bounds, AffineMap.Identity);
            }
        }

        return [.. points._farthest.Where(static cell => cell.DistanceSquared > 0).Select(static cell => cell.Point), scene.Bounds.Centre];
    }

    /// <summary>Adds an object. Returns false for one of which only the bounds are known.</summary>
    private bool TryAdd(PlacedModel placed)
    {
        if (placed.Model is not FractalModel { Fractal: var fractal })
        {
            var mesh = placed.Model.Mesh;
            for (var i = 0; i < mesh.VertexCount; i++)
            {
                Add(placed.ObjectToWorld * mesh.Vertex(i));
            }

            return true;
        }

        if (fractal.Description.Composition != Composition.Affine)
        {
            return false;
        }

        try
        {
            AddParts(LodHierarchy.Build(fractal), placed.ObjectToWorld);
            return true;
        }
        catch (Exception exception) when (exception is FractalLimitException or SingularMatrixException)
        {
            return false;
        }
    }

    /// <summary>Adds the boxes of sub-fractals of about equal depth.</summary>
    private void AddParts(LodHierarchy hierarchy, AffineMap objectToWorld)
    {
        var parts = new Queue<(LevelState State, AffineMap Map)>([(hierarchy.Start, objectToWorld)]);
        // Every part of an infinite fractal has children: after enough parts, none is opened any more.
        var isFull = false;
        var openedCount = 0;
        while (parts.TryDequeue(out var part))
        {
            var node = hierarchy.NodeAt(part.State.Level);
            if (node.IsEmpty)
            {
                continue;
            }

            isFull |= parts.Count + node.ChildMaps.Length > MaxBoxes || ++openedCount > MaxBoxes;
            if (node.ChildMaps.Length == 0 || isFull)
            {
                AddCorners(node.Box, part.Map);
                continue;
            }

            for (var child = 0; child < node.ChildMaps.Length; child++)
            {
                parts.Enqueue((hierarchy.Enter(node, child, part.State), part.Map * node.ChildMaps[child].ToAffineMap()));
            }
        }
    }

    private void AddCorners(BoundingBox box, AffineMap map)
    {
        for (var corner = 0; corner < 8; corner++)
        {
            Add(map * box.Corner(corner));
        }
    }

    private void Add(Vector point)
    {
        var offset = point - centre;
        var extent = offset.MaxAbsComponent();
        var distanceSquared = Vector.Dot(offset, offset);
        if (!(extent > 0) || !double.IsFinite(distanceSquared))
        {
            return;
        }

        ref var farthest = ref _farthest[CellOf(offset / extent)];
        if (distanceSquared > farthest.DistanceSquared)
        {
            farthest = (distanceSquared, point);
        }
    }

    /// <summary>Returns the cell of a direction whose greatest component is 1.</summary>
    private static int CellOf(Vector direction)
    {
        var (x, y, z) = direction;
        var (face, u, v) = Math.Abs(x) >= 1 ? (x > 0 ? 0 : 1, y, z) : Math.Abs(y) >= 1 ? (y > 0 ? 2 : 3, z, x) : (z > 0 ? 4 : 5, x, y);
        return (((face * CellsPerEdge) + Cell(u)) * CellsPerEdge) + Cell(v);
    }

    private static int Cell(double coordinate) => Math.Clamp((int)((coordinate + 1) * 0.5 * CellsPerEdge), 0, CellsPerEdge - 1);
}
