using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Passes;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Shadows;

/// <summary>The views of depth maps in a uniform buffer, laid out as <c>ShadowBlock</c> in shadows.glsl (std140).</summary>
internal sealed class ShadowBlock(GlResources resources, bool hasReversedDepth) : IDisposable
{
    /// <summary>Number of slots for views: one for each light, those of further views, and an empty one.</summary>
    public const int SlotCount = LightBlock.MaxLights + ShadowFit.MaxViews;

    private const int FloatsPerView = 24;
    private const int EmptySlot = SlotCount - 1;

    // Ranges, then sides, four integers and eight for each light; then the size of a texel, and the views.
    private const int SidesStart = 4 * LightBlock.MaxLights;
    private const int TexelStart = 12 * LightBlock.MaxLights;
    private const int ViewsStart = TexelStart + 4;
    private const int SideCount = 6;

    // Distance towards the light at which a surface is compared with the map, texels: parts below a texel may be drawn as proxies there.
    private const double OffsetTexels = 1.3;

    private readonly GlBuffer _buffer = new(resources, "shadows", BufferTarget.UniformBuffer);
    private readonly float[] _data = new float[ViewsStart + (SlotCount * FloatsPerView)];

    /// <summary>Uploads the views, relative to a camera.</summary>
    /// <param name="ranges">First view of each light, and their number.</param>
    /// <param name="views">Views of all lights.</param>
    /// <param name="corners">Corner of each view's map in the atlas.</param>
    /// <param name="textureSize">Width and height of the atlas, texels.</param>
    /// <param name="origin">Position of the camera in the space of the views.</param>
    public void Upload(
        IReadOnlyList<(int First, int Count)> ranges, IReadOnlyList<ShadowView> views, IReadOnlyList<(int X, int Y)> corners,
        (int Width, int Height) textureSize, Vector origin)
    {
        var indices = MemoryMarshal.Cast<float, int>(_data.AsSpan(0, TexelStart));
        (_data[TexelStart], _data[TexelStart + 1]) = (1f / textureSize.Width, 1f / textureSize.Height);
        // Without bounds, no slot holds any point.
        _data.AsSpan(ViewsStart).Clear();
        var nextSlot = LightBlock.MaxLights;
        for (var light = 0; light < ranges.Count; light++)
        {
            var (first, count) = ranges[light];
            (indices[4 * light], indices[(4 * light) + 1]) = (nextSlot, Math.Max(0, count - 1));
            var sides = indices.Slice(SidesStart + (8 * light), SideCount);
            sides.Fill(count > 0 && views[first].IsCubeSide ? EmptySlot : light);
            for (var i = first; i < first + count; i++)
            {
                // The index of the first view is known to the shader's compiler.
                var slot = i == first ? light : nextSlot++;
                Write(views[i], corners[i], origin, _data.AsSpan(ViewsStart + (slot * FloatsPerView), FloatsPerView));
                if (views[i].IsCubeSide)
                {
                    sides[SideOf(views[i].Axes.V3)] = slot;
                }
            }
        }

        _buffer.Upload<float>(_data, BufferUsageHint.DynamicDraw);
    }

    /// <summary>Binds the block to its binding point.</summary>
    public void Bind() => _buffer.BindTo(MeshPass.ShadowBinding);

    /// <inheritdoc/>
    public void Dispose() => _buffer.Dispose();

    /// <summary>Returns the index of the side of a cube that an axis points to: +x, −x, +y, −y, +z, −z.</summary>
    private static int SideOf(Vector axis) =>
        Math.Abs(axis.X) > 0.5 ? (axis.X > 0 ? 0 : 1) : Math.Abs(axis.Y) > 0.5 ? (axis.Y > 0 ? 2 : 3) : axis.Z > 0 ? 4 : 5;

    private void Write(in ShadowView view, (int X, int Y) corner, Vector origin, Span<float> target)
    {
        var (right, up, forward) = view.Axes;
        var toCamera = origin - view.Position;
        var half = 0.5 * view.Size;
        var (depthScale, depthShift) = StoredDepth(in view);
        WriteVector(target, right, Vector.Dot(right, toCamera));
        WriteVector(target[4..], up, Vector.Dot(up, toCamera));
        // The shift is added in double precision where that is possible.
        WriteVector(target[8..], forward, Vector.Dot(forward, toCamera) + (view.IsPerspective ? 0 : depthShift / depthScale));
        WriteVector(target[12..], new(half / view.HalfWidth, half / view.HalfHeight, corner.X + half), corner.Y + half);
        WriteVector(target[16..], new(corner.X + 1, corner.Y + 1, corner.X + view.Size - 1), corner.Y + view.Size - 1);
        WriteVector(target[20..], new(depthScale, depthShift, view.IsPerspective ? 1 : 0), OffsetTexels * view.TexelSize);
    }

    /// <summary>
    /// Coefficients of the stored depth: Scale·depth + Shift of parallel light, Scale + Shift/depth of a light with a position.
    /// </summary>
    private (double Scale, double Shift) StoredDepth(in ShadowView view)
    {
        var (zByDepth, z, _, _) = view.DepthScale;
        // Without clip control, depths from −1 to 1 are stored as 0 to 1: half of each, and a half is added to what does not depend on depth.
        return hasReversedDepth ? (zByDepth, z)
            : view.IsPerspective ? (0.5 * (zByDepth + 1), 0.5 * z)
            : (0.5 * zByDepth, 0.5 * (z + 1));
    }

    private static void WriteVector(Span<float> target, Vector vector, double w) =>
        (target[0], target[1], target[2], target[3]) = ((float)vector.X, (float)vector.Y, (float)vector.Z, (float)w);
}
