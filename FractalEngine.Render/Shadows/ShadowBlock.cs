using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Lights;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Shadows;

/// <summary>The views of depth maps in a uniform buffer, laid out as <c>ShadowBlock</c> in shadows.glsl (std140).</summary>
internal sealed class ShadowBlock(GlResources resources, bool hasReversedDepth) : IDisposable
{
    /// <summary>Number of slots for views: one for each light, those of further views, and an empty one.</summary>
    public const int SlotCount = LightBlock.MaxLights + ShadowFit.MaxViews;

    private const int FloatsPerView = 24;
    private const int SideCount = 6;

    // Ranges, then sides, one vector and six for each light; then the size of a texel, and the views.
    private const int SidesStart = 4 * LightBlock.MaxLights;
    private const int FloatsPerCube = 4 * SideCount;
    private const int TexelStart = SidesStart + (FloatsPerCube * LightBlock.MaxLights);
    private const int ViewsStart = TexelStart + 4;

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
        var indices = MemoryMarshal.Cast<float, int>(_data.AsSpan(0, SidesStart));
        // Without bounds, no slot holds any point, and sides without a scale have no map.
        _data.AsSpan(SidesStart).Clear();
        (_data[TexelStart], _data[TexelStart + 1]) = (1f / textureSize.Width, 1f / textureSize.Height);
        var nextSlot = LightBlock.MaxLights;
        for (var light = 0; light < ranges.Count; light++)
        {
            var (first, count) = ranges[light];
            (indices[4 * light], indices[(4 * light) + 1]) = (nextSlot, 0);
            for (var i = first; i < first + count; i++)
            {
                // The index of the first view is known to the shader's compiler.
                if (i == first || !views[i].IsCubeSide)
                {
                    var slot = i == first ? light : nextSlot++;
                    Write(views[i], corners[i], origin, _data.AsSpan(ViewsStart + (slot * FloatsPerView), FloatsPerView));
                }

                if (views[i].IsCubeSide)
                {
                    var side = SidesStart + (light * FloatsPerCube) + (4 * SideOf(views[i].Axes.V3));
                    WriteSide(views[i], corners[i], _data.AsSpan(side, 4));
                }
            }

            indices[(4 * light) + 1] = nextSlot - indices[4 * light];
        }

        _buffer.Upload<float>(_data, BufferUsageHint.DynamicDraw);
    }

    /// <summary>Binds the block to its binding point.</summary>
    public void Bind() => _buffer.BindTo(GlState.ShadowBinding);

    /// <inheritdoc/>
    public void Dispose() => _buffer.Dispose();

    /// <summary>Returns the index of the side of a cube that an axis points to: +x, −x, +y, −y, +z, −z.</summary>
    private static int SideOf(Vector axis) =>
        Math.Abs(axis.X) > 0.5 ? (axis.X > 0 ? 0 : 1) : Math.Abs(axis.Y) > 0.5 ? (axis.Y > 0 ? 2 : 3) : axis.Z > 0 ? 4 : 5;

    private static void WriteSide(in ShadowView view, (int X, int Y) corner, Span<float> target)
    {
        var half = 0.5 * view.Size;
        LightBlock.WriteVector(new(corner.X + half, corner.Y + half, half / view.HalfWidth), OffsetTexels * view.TexelSize, target);
    }

    private void Write(in ShadowView view, (int X, int Y) corner, Vector origin, Span<float> target)
    {
        var half = 0.5 * view.Size;
        var (scaleX, scaleY) = (half / view.HalfWidth, half / view.HalfHeight);
        var middle = new Vector(corner.X + half, corner.Y + half, 0);
        var (depthScale, depthShift) = StoredDepth(in view);
        // Shifts are added in double precision where that is possible.
        if (view.IsPerspective)
        {
            WriteRows(in view, origin, new(scaleX, scaleY, 1), Vector.Zero, target);
            LightBlock.WriteVector(new(depthScale, depthShift, 1 / (scaleX * scaleX)), 1 / (scaleY * scaleY), target[20..]);
        }
        else
        {
            WriteRows(in view, origin, new(scaleX, scaleY, depthScale), new(middle.X, middle.Y, depthShift), target);
            var (ratioX, ratioY) = (depthScale / scaleX, depthScale / scaleY);
            LightBlock.WriteVector(new(0, 0, -ratioX * ratioX), -ratioY * ratioY, target[20..]);
        }

        LightBlock.WriteVector(new(corner.X + 1, corner.Y + 1, corner.X + view.Size - 1), corner.Y + view.Size - 1, target[12..]);
        LightBlock.WriteVector(middle, OffsetTexels * view.TexelSize, target[16..]);
    }

    /// <summary>Writes the map from points relative to the camera to the axes of a view.</summary>
    private static void WriteRows(in ShadowView view, Vector origin, Vector scale, Vector shift, Span<float> target)
    {
        var (right, up, forward) = view.Axes;
        var toCamera = origin - view.Position;
        LightBlock.WriteVector(scale.X * right, (scale.X * Vector.Dot(right, toCamera)) + shift.X, target);
        LightBlock.WriteVector(scale.Y * up, (scale.Y * Vector.Dot(up, toCamera)) + shift.Y, target[4..]);
        LightBlock.WriteVector(scale.Z * forward, (scale.Z * Vector.Dot(forward, toCamera)) + shift.Z, target[8..]);
    }

    /// <summary>
    /// Coefficients of the stored depth: Scale·depth + Shift of parallel light, Scale + Shift/depth of a light with a position.
    /// </summary>
    private (double Scale, double Shift) StoredDepth(in ShadowView view)
    {
        var (zByDepth, z, _, _) = view.DepthScale;
        // Without clip control, depths from −1 to 1 are stored as 0 to 1: half of each, and a half is added to what does not
        // depend on depth.
        return hasReversedDepth ? (zByDepth, z)
            : view.IsPerspective ? (0.5 * (zByDepth + 1), 0.5 * z)
            : (0.5 * zByDepth, 0.5 * (z + 1));
    }
}
