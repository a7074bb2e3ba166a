using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Fractals;

/// <summary>Visits the faces of a shape that a visitor may look for, depth first.</summary>
internal static class ShapeWalk
{
    /// <summary>Visits the nodes of a shape depth first, the nearest child first, until the visitor has enough.</summary>
    /// <typeparam name="TVisitor">What is looked for; a struct, so that the walk is compiled for it.</typeparam>
    /// <param name="tree">The shape.</param>
    /// <param name="map">From its frame to that of the query.</param>
    /// <param name="visitor">What is looked for.</param>
    /// <param name="statistics">Receives the cost.</param>
    public static ShapeWalkEnd Run<TVisitor>(ShapeTree tree, in AffineMap map, ref TVisitor visitor, QueryStatistics statistics)
        where TVisitor : struct, IShapeVisitor
    {
        if (tree.IsEmpty)
        {
            return ShapeWalkEnd.Completed;
        }

        var minRadiusSquared = tree.MinRadiusSquared(in map);
        var boundTests = 1L;
        var faceTests = 0L;
        var end = Run(tree, tree.Root(in map), minRadiusSquared, ref visitor, ref boundTests, ref faceTests);
        statistics.BoundTests += boundTests;
        statistics.FaceTests += faceTests;
        return end;
    }

    /// <summary>Visits a part of a shape depth first, the nearest child first, until the visitor has enough.</summary>
    /// <typeparam name="TVisitor">What is looked for; a struct, so that the walk is compiled for it.</typeparam>
    /// <param name="tree">The shape.</param>
    /// <param name="root">The part.</param>
    /// <param name="minRadiusSquared">See <see cref="ShapeTree.MinRadiusSquared"/>.</param>
    /// <param name="visitor">What is looked for.</param>
    /// <param name="boundTests">Receives the cost.</param>
    /// <param name="faceTests">Receives the cost, too.</param>
    public static ShapeWalkEnd Run<TVisitor>(
        ShapeTree tree, ShapeNode root, double minRadiusSquared, ref TVisitor visitor, ref long boundTests, ref long faceTests)
        where TVisitor : struct, IShapeVisitor
    {
        // The path to the node on top of the stack: its ancestors are not replaced before all their children are visited.
        var path = new int[16];
        var stack = new List<Entry>();
        if (!TryPush(new(root, visitor.Measure(in root), -1, 0), stack))
        {
            return ShapeWalkEnd.Found;
        }

        while (stack.Count > 0)
        {
            var (node, _, childIndex, depth) = stack[^1];
            stack.RemoveAt(stack.Count - 1);
            if (childIndex >= 0)
            {
                path = EnsureLength(path, depth);
                path[depth - 1] = childIndex;
            }

            var childCount = tree.ChildCount(in node);
            if (childCount == 0)
            {
                foreach (var face in tree.Faces(in node))
                {
                    faceTests++;
                    var (a, b, c) = tree.Triangle(node.Map, face);
                    if (!visitor.Visit(face, a, b, c, in node, path.AsSpan(0, depth)))
                    {
                        return ShapeWalkEnd.Found;
                    }
                }

                continue;
            }

            boundTests += childCount;
            if (boundTests > visitor.MaxBoundTests)
            {
                return ShapeWalkEnd.LimitMet;
            }

            var childDepth = node.IsBase ? depth : depth + 1;
            var first = stack.Count;
            for (var i = 0; i < childCount; i++)
            {
                if (tree.TryGetChild(in node, i, minRadiusSquared, childDepth, out var child)
                    && !TryPush(new(child, visitor.Measure(in child), node.IsBase ? -1 : i, childDepth), stack))
                {
                    return ShapeWalkEnd.Found;
                }
            }

            MoveNearestToTop(CollectionsMarshal.AsSpan(stack)[first..]);
        }

        return ShapeWalkEnd.Completed;
    }

    /// <summary>Pushes a node unless nothing in it counts.</summary>
    /// <returns>False when the visitor has found what it looks for.</returns>
    private static bool TryPush(in Entry entry, List<Entry> stack)
    {
        if (!double.IsPositiveInfinity(entry.Measure))
        {
            stack.Add(entry);
        }

        return !double.IsNegativeInfinity(entry.Measure);
    }

    private static void MoveNearestToTop(Span<Entry> entries)
    {
        var nearest = entries.Length - 1;
        for (var i = 0; i < entries.Length - 1; i++)
        {
            nearest = entries[i].Measure < entries[nearest].Measure ? i : nearest;
        }

        if (nearest >= 0)
        {
            (entries[nearest], entries[^1]) = (entries[^1], entries[nearest]);
        }
    }

    private static int[] EnsureLength(int[] path, int length)
    {
        if (path.Length < length)
        {
            Array.Resize(ref path, 2 * length);
        }

        return path;
    }

    private readonly record struct Entry(ShapeNode Node, double Measure, int ChildIndex, int Depth);
}
