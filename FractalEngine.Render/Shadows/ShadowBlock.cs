using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Passes;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Shadows;

/// <summary>The views of depth maps in a uniform buffer, laid out as <c>ShadowBlock</c> in shadows.glsl (std140).</summary>
internal sealed class ShadowBlock(GlResources resources, bool hasReversedDepth) : IDisposable
{
    private const int FloatsPerView = 24;
    private const int RangeFloats = 4 * LightBlock.MaxLights;

    // Distance towards the light at which a surface is compared with the map, texels: parts below a texel may be drawn as proxies there.
    private const double OffsetTexels = 1.3;

    private readonly GlBuffer _buffer = new(resources, "shadows", BufferTarget.UniformBuffer);
    private readonly float[] _data = new float[RangeFloats + (ShadowFit.MaxViews * FloatsPerView)];

    /// <summary>Uploads the views, relative to a camera.</summary>
    /// <param name="ranges">First view of each light, and their number.</param>
    /// <param name="views">Views of all lights.</param>
    /// <param name="corners">Corner of each view's map in the atlas.</param>
    /// <param name="origin">Position of the camera in the space of the views.</param>
    public void Upload(
        IReadOnlyList<(int First, int Count)> ranges, IReadOnlyList<ShadowView> views, IReadOnlyList<(int X, int Y)> corners, Vector origin)
    {
        var indices = MemoryMarshal.Cast<float, int>(_data.AsSpan(0, RangeFloats));
        for (var i = 0; i < ranges.Count; i++)
        {
            (indices[4 * i], indices[(4 * i) + 1]) = ranges[i];
        }

        for (var i = 0; i < views.Count; i++)
        {
            Write(views[i], corners[i], origin, _data.AsSpan(RangeFloats + (i * FloatsPerView), FloatsPerView));
        }

        _buffer.Upload<float>(_data, BufferUsageHint.DynamicDraw);
    }

    /// <summary>Binds the block to its binding point.</summary>
    public void Bind() => _buffer.BindTo(MeshPass.ShadowBinding);

    /// <inheritdoc/>
    public void Dispose() => _buffer.Dispose();

    private void Write(in ShadowView view, (int X, int Y) corner, Vector origin, Span<float> target)
    {
        // In the axes of the light a point p relative to the camera is A·p + b.
        var (right, up, forward) = view.Axes;
        var toCamera = origin - view.Position;
        var half = 0.5 * view.Size;
        var depth = view.DepthScale;
        // A row is the coefficients of x, y, z and a constant.
        var w = (Vector: depth.WByDepth * forward, Constant: (depth.WByDepth * Vector.Dot(forward, toCamera)) + depth.W);
        WriteRow(target, half / view.HalfWidth, right, toCamera, corner.X + half, w);
        WriteRow(target[4..], half / view.HalfHeight, up, toCamera, corner.Y + half, w);
        var z = (Vector: depth.ZByDepth * forward, Constant: (depth.ZByDepth * Vector.Dot(forward, toCamera)) + depth.Z);
        // Without clip control, depths from −1 to 1 are stored as 0 to 1.
        WriteRow(
            target[8..], hasReversedDepth ? z.Vector : (0.5 * z.Vector) + (0.5 * w.Vector),
            hasReversedDepth ? z.Constant : (0.5 * z.Constant) + (0.5 * w.Constant));
        WriteRow(target[12..], w.Vector, w.Constant);
        (target[16], target[17]) = (corner.X + 1, corner.Y + 1);
        (target[18], target[19]) = (corner.X + view.Size - 1, corner.Y + view.Size - 1);
        var offset = (float)(OffsetTexels * view.TexelSize);
        var (acrossRatio, downRatio) = (depth.ZByDepth * view.HalfWidth / half, depth.ZByDepth * view.HalfHeight / half);
        var scale = hasReversedDepth ? 1 : 0.25;
        (target[22], target[23]) = ((float)(scale * acrossRatio * acrossRatio), (float)(scale * downRatio * downRatio));
        (target[20], target[21]) = view.IsPerspective ? (0f, offset) : (offset, 0f);
    }

    /// <summary>Writes scale · (axis · (p + toCamera)) + shift · w.</summary>
    private static void WriteRow(
        Span<float> target, double scale, Vector axis, Vector toCamera, double shift, (Vector Vector, double Constant) w) =>
        WriteRow(target, (scale * axis) + (shift * w.Vector), (scale * Vector.Dot(axis, toCamera)) + (shift * w.Constant));

    private static void WriteRow(Span<float> target, Vector vector, double constant) =>
        (target[0], target[1], target[2], target[3]) = ((float)vector.X, (float)vector.Y, (float)vector.Z, (float)constant);
}
