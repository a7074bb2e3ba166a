using System.Collections.Immutable;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Approximation;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;

namespace FractalEngine.App.Approximation;

/// <summary>Shows a mesh, the fractal for it, and how far the one is from the other, side by side.</summary>
internal static class ApproximationImage
{
    private const int TileSize = 720;

    // Less than what counts as exact is no distance, but rounding.
    private const double SmallestShown = 1e-6;

    // From no distance to the largest: dark blue, cyan, yellow, red.
    private static readonly Vector[] Ramp = [new(0.1, 0.15, 0.5), new(0.2, 0.75, 0.8), new(0.95, 0.9, 0.25), new(0.85, 0.1, 0.1)];

    /// <summary>Draws three squares beside each other.</summary>
    /// <param name="mesh">The mesh.</param>
    /// <param name="result">What was found for it.</param>
    /// <exception cref="GraphicsUnavailableException">There is no display, or no OpenGL 3.3.</exception>
    public static PixelImage Draw(Mesh mesh, ApproximationResult result)
    {
        var text = new ApproximationText(mesh, result);
        var lines = text.Lines().ToArray();
        var (coloured, largest) = ColourByDistance(mesh, result.Made);
        var scenes = new[] { mesh, result.Made, coloured }
            .Select(shown => LoadedScene.Of(new() { Objects = [new SceneObject(shown)] })).ToArray();
        var view = View.Of(scenes[0], 1);
        using var context = new OffscreenContext();
        using var renderer = new FrameRenderer(context);
        return Join(
            DrawTile(0, FormattableString.Invariant($"the mesh: {mesh.FaceCount} faces")),
            DrawTile(1, [FormattableString.Invariant($"the fractal: {result.Made.FaceCount} faces, {result.Bytes} bytes"), .. lines]),
            DrawTile(2, FormattableString.Invariant(
                $"distance of the mesh from it: blue none, red {largest / mesh.UsedBounds.Diagonal:0.0e+0} of the diagonal")));

        PixelImage DrawTile(int index, params ReadOnlySpan<string> caption)
        {
            var settings = new RenderSettings();
            using var scene = new SceneRenderer(context, DrawableScene.Prepare(scenes[index], settings));
            renderer.Draw(scene, view, TileSize, TileSize, settings);
            return renderer.Capture(overlay: OverlayPanel.OfText(OverlayAnchor.BottomLeft, caption));
        }
    }

    private static (Mesh Coloured, double Largest) ColourByDistance(Mesh mesh, Mesh made)
    {
        var (collider, context) = (new HierarchyCollider(made), new QueryContext());
        var distances = new double[mesh.VertexCount];
        foreach (var vertex in mesh.VertexIndices)
        {
            var isFound = collider.TryFindClosest(mesh.Vertex(vertex), double.PositiveInfinity, context, out var closest);
            distances[vertex] = isFound ? closest.Distance : 0;
        }

        var largest = Math.Max(distances.Max(), SmallestShown * mesh.UsedBounds.Diagonal);
        var colours = ImmutableArray.CreateBuilder<double>(3 * distances.Length);
        foreach (var distance in distances)
        {
            var place = (Ramp.Length - 1) * distance / largest;
            var from = Math.Min((int)place, Ramp.Length - 2);
            var (red, green, blue) = Ramp[from] + ((place - from) * (Ramp[from + 1] - Ramp[from]));
            colours.AddRange(red, green, blue);
        }

        return (mesh.WithColours(colours.MoveToImmutable()), largest);
    }

    private static PixelImage Join(params PixelImage[] tiles)
    {
        var stride = 4 * TileSize;
        var pixels = new byte[tiles.Length * stride * TileSize];
        for (var row = 0; row < TileSize; row++)
        {
            for (var tile = 0; tile < tiles.Length; tile++)
            {
                tiles[tile].Pixels.AsSpan(row * stride, stride).CopyTo(pixels.AsSpan(((row * tiles.Length) + tile) * stride));
            }
        }

        return new(tiles.Length * TileSize, TileSize, pixels);
    }
}
