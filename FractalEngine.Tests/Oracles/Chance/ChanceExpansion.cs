using System.Collections.Immutable;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Oracles.Graphs.Expansion;
using FractalEngine.Tests.Oracles.Graphs.Models;

namespace FractalEngine.Tests.Oracles.Chance;

/// <summary>Spells out what stands at each place, one way after the other.</summary>
internal sealed class ChanceExpansion
{
    // Sizes that are closer to that of an end, as a part of it, are left to rounding.
    private const double LeftToRounding = 1e-5;

    private const int MaxLevels = 1000;

    private readonly List<PlacedMesh> _instances = [];
    private readonly int _maxInstances;
    private readonly int _maxFaces;
    private long _stepsLeft = 300_000;
    private int _faces;

    private ChanceExpansion(int maxInstances, int maxFaces)
    {
        _maxInstances = maxInstances;
        _maxFaces = maxFaces;
    }

    /// <summary>Expands a model; null for one that is too large, or left out.</summary>
    public static ImmutableArray<PlacedMesh>? TryExpand(GraphFile file, ChanceOptions options)
    {
        try
        {
            return ChanceResolver.TryResolve(file) is { } node ? Expand(node, options.MaxInstances, options.MaxFaces) : null;
        }
        catch (UnclearModelException)
        {
            return null;
        }
    }

    /// <summary>Expands a node that has no calls.</summary>
    /// <exception cref="UnclearModelException">It is too large, or rounding decides where something ends.</exception>
    public static ImmutableArray<PlacedMesh> Expand(ChanceNode node, int maxInstances = 5000, int maxFaces = 60_000)
    {
        ChanceExpansion expansion = new(maxInstances, maxFaces);
        expansion.Expand(node, new(RowMap.Identity, 0, 1, default), null);
        return [.. expansion._instances];
    }

    /// <summary>The diagonal of the box of a node.</summary>
    public static double Diagonal(ChanceNode node)
    {
        var (low, high) = (double.PositiveInfinity * Vector.One, double.NegativeInfinity * Vector.One);
        foreach (var (mesh, map, _) in Expand(node))
        {
            // Whether corners without a face count is not said.
            ChanceResolver.Require(mesh.Indices.Distinct().Count() == mesh.Vertices.Length, "vertices without a face");
            foreach (var vertex in mesh.Vertices.Select(map.Apply))
            {
                (low, high) = (Vector.Min(low, vertex), Vector.Max(high, vertex));
            }
        }

        return (high - low).Length();
    }

    private void Expand(ChanceNode node, Place place, Frame? frame)
    {
        ChanceResolver.Require(--_stepsLeft >= 0, "too many steps");
        switch (node)
        {
            case ChanceNode.Base(var mesh):
                Add(mesh, place);
                break;
            case ChanceNode.Whole(var inner):
                ExpandMapped(inner, place.To(1), frame);
                break;
            case ChanceNode.Mapped mapped:
                ExpandMapped(mapped, place.To(1), frame);
                break;
            case ChanceNode.Sum(var terms):
                for (var i = 0; i < terms.Length; i++)
                {
                    ExpandMapped(terms[i], place.To(i + 1), frame);
                }

                break;
            case ChanceNode.Choice choice:
                var chosen = Choose(choice, place, frame);
                Expand(choice.Alternatives[chosen].Node, place.To(chosen + 1), frame);
                break;
            case ChanceNode.Recursive recursive:
                ExpandRecursive(new(recursive, 0), recursive.Index, place);
                break;
            case ChanceNode.Call(var index):
                ExpandRecursive(frame! with { Level = frame.Level + 1 }, index, place);
                break;
        }
    }

    private void ExpandMapped(ChanceNode.Mapped mapped, Place place, Frame? frame)
    {
        for (var i = 0; i < mapped.Maps.Length; i++)
        {
            var (map, reach) = (place.Map, place.Reach);
            foreach (var step in mapped.Maps[i].Steps)
            {
                map = map.After(step);
                reach = Math.Max(reach, TriangleSoup.Largest(map.Translation));
            }

            Expand(mapped.Inner, new(map, reach, place.Stretch * mapped.Maps[i].Stretch, place.Way.To(i + 1)), frame);
        }
    }

    private static int Choose(ChanceNode.Choice choice, Place place, Frame? frame)
    {
        var way = choice switch
        {
            { IsByLevel: false } => place.Way,
            { IsInBody: false } => default(ChanceWay).To(1).To(1),
            _ => default(ChanceWay).To(frame!.Level + 1).To(1),
        };
        return way.Choose(choice.Alternatives.Select(static one => one.Weight), choice.Seed);
    }

    private void ExpandRecursive(Frame frame, int index, Place place)
    {
        var group = frame.Recursive.Group;
        ChanceResolver.Require(frame.Level < MaxLevels, "so many levels that the stack is too small");
        if (!GoesOn(frame, index, place))
        {
            Expand(group.Bases[index], place, null);
            return;
        }

        var body = group.Bodies[index];
        var isAlone = !group.IsSets && body is ChanceNode.Base or ChanceNode.Call or ChanceNode.Recursive or ChanceNode.Whole;
        Expand(body, isAlone ? place.To(1).To(1) : place, frame);
    }

    private static bool GoesOn(Frame frame, int index, Place place)
    {
        if (frame.Recursive.Size is not { } size)
        {
            return frame.Level < frame.Recursive.Depth;
        }

        var found = place.Stretch * frame.Recursive.Group.Diagonals[index];
        ChanceResolver.Require(Math.Abs(found - size) > LeftToRounding * size, "a size at the end");
        return found >= size;
    }

    private void Add(OracleMesh mesh, Place place)
    {
        _faces += mesh.FaceCount;
        ChanceResolver.Require(_instances.Count < _maxInstances && _faces <= _maxFaces, "too many instances");
        _instances.Add(new(mesh, place.Map, place.Reach));
    }

    /// <summary>A place on the way from the whole inwards.</summary>
    private readonly record struct Place(RowMap Map, double Reach, double Stretch, ChanceWay Way)
    {
        public Place To(int number) => this with { Way = Way.To(number) };
    }

    /// <summary>A recursive whose body is expanded, and the number of its levels above.</summary>
    private sealed record Frame(ChanceNode.Recursive Recursive, int Level);
}
