using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;

namespace FractalEngine.Render.Tracing;

/// <summary>Finds what is seen in each pixel of a view, without its light.</summary>
/// <remarks>
/// Depth, position and level are those of one ray through the middle of the pixel, since a mean of two surfaces is none. Albedo and normal
/// are means of <see cref="RayCount"/> rays behind the pixel's filter. Surfaces that let most light pass are passed.
/// </remarks>
/// <param name="scene">The surfaces, for the view.</param>
/// <param name="camera">The view.</param>
/// <param name="width">Width of the image in pixels.</param>
/// <param name="height">Height of the image in pixels.</param>
internal sealed class SurfaceLayers(TracedScene scene, TracedCamera camera, int width, int height)
{
    // Enough for edges that are as smooth as those of drawn images.
    private const int RayCount = 16;

    private readonly float[] _albedo = new float[3 * width * height];
    private readonly float[] _normal = new float[3 * width * height];
    private readonly float[] _position = new float[3 * width * height];
    private readonly float[] _depth = new float[width * height];
    private readonly float[] _level = new float[width * height];

    /// <summary>Finds the channels of all layers but those of light.</summary>
    /// <param name="layers">Which layers are wanted.</param>
    /// <param name="options">Threads, and cancellation between rows.</param>
    /// <exception cref="OperationCanceledException">The work was cancelled.</exception>
    public IEnumerable<ImageChannel> Find(IReadOnlyCollection<FrameLayer> layers, ParallelOptions options)
    {
        Array.Fill(_depth, float.PositiveInfinity);
        Array.Fill(_level, -1);
        var hasMeans = layers.Contains(FrameLayer.Albedo) || layers.Contains(FrameLayer.Normal);
        var (left, top, columns, rows) = camera.Viewport;
        Parallel.For(top, top + rows, options, static () => new QueryContext(), (y, _, context) =>
        {
            for (var x = left; x < left + columns; x++)
            {
                AddMiddle(x, y, context);
                for (var sample = 0; hasMeans && sample < RayCount; sample++)
                {
                    AddMeans(x, y, sample, context);
                }
            }

            return context;
        }, static _ => { });
        return layers.SelectMany(layer => layer switch
        {
            FrameLayer.Albedo => ImageChannel.Of(["albedo.R", "albedo.G", "albedo.B"], _albedo, areHalf: true),
            FrameLayer.Normal => ImageChannel.Of(["normal.X", "normal.Y", "normal.Z"], _normal, areHalf: true),
            FrameLayer.Position => ImageChannel.Of(["position.X", "position.Y", "position.Z"], _position, areHalf: false),
            FrameLayer.Depth => [new("Z", _depth)],
            FrameLayer.Level => [new("level.X", _level)],
            _ => [],
        });
    }

    private void AddMiddle(int x, int y, QueryContext context)
    {
        if (TryFind(x, y, (0.5, 0.5), context, out var surface))
        {
            var pixel = (y * width) + x;
            Add(_position, pixel, surface.Position);
            _depth[pixel] = (float)camera.DepthOf(surface.Position);
            _level[pixel] = surface.Lamp is null ? scene.LevelOf(context) : 0;
        }
    }

    private void AddMeans(int x, int y, int sample, QueryContext context)
    {
        var point = new SampleSequence((y * width) + x, sample, seed: 0).Next();
        if (TryFind(x, y, point, context, out var surface))
        {
            var pixel = (y * width) + x;
            Add(_albedo, pixel, surface.Albedo / RayCount);
            Add(_normal, pixel, surface.Normal / RayCount);
        }
    }

    private static void Add(float[] sums, int pixel, Vector value)
    {
        sums[3 * pixel] += (float)value.X;
        sums[(3 * pixel) + 1] += (float)value.Y;
        sums[(3 * pixel) + 2] += (float)value.Z;
    }

    private bool TryFind(int x, int y, (double U, double V) point, QueryContext context, out TracedSurface surface)
    {
        var ray = camera.CreateRay(x, y, point, out var footprint, out var clip);
        var path = new LightPath(ray, footprint, clip);
        while (scene.TryIntersect(path.Ray, path.Footprint, path.Clip.Near, path.Clip.Far, context, out surface))
        {
            var passed = (surface.Position - path.Ray.Origin).Length();
            if (surface.Glass is not null || surface.Opacity >= 0.5 || !path.TryPassLayer(passed + scene.OffsetAt(surface.Position)))
            {
                return true;
            }
        }

        return false;
    }
}
