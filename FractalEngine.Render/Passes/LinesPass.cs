using System.Runtime.InteropServices;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Windowing;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Passes;

/// <summary>The ground grid on y = 0 and the three axes, where they are asked for.</summary>
internal sealed class LinesPass : IDisposable
{
    private const int Floats = 7;

    // Lines to each side of the middle; every tenth is stronger.
    private const int GridLines = 20;

    private readonly ChangeCounter _uploads;
    private readonly ShaderProgram _program;
    private readonly ViewUniforms _view;
    private readonly int _offset;
    private readonly GlBuffer _lines;
    private readonly VertexArray _array;
    private readonly List<float> _data = [];
    private (bool Grid, bool Axes, double Spacing, Vector Middle)? _last;

    /// <summary>Builds the program.</summary>
    public LinesPass(RenderContext context)
    {
        _uploads = context.Resources.Uploads;
        _program = ShaderProgram.Load(context.Resources, "lines");
        _view = new(_program, context.Resources.State.Changes, context.HasReversedDepth);
        _offset = _program.Uniform("offset");
        _lines = new(context.Resources, "grid and axes", BufferTarget.ArrayBuffer);
        _array = new(context.Resources, "grid and axes");
        _array.Attribute(_lines, 0, 3, Floats, 0);
        _array.Attribute(_lines, 1, 4, Floats, 3);
        _array.Unbind();
    }

    /// <summary>What the lines reach beyond the scene, for planes that hold both.</summary>
    public static BoundingBox BoundsWith(BoundingBox scene, RenderSettings settings)
    {
        if (!settings.Grid && !settings.Axes)
        {
            return scene;
        }

        var (spacing, middle) = Layout(scene);
        var reach = GridLines * spacing;
        return BoundingBox.Union(scene, new(middle - new Vector(reach, 0, reach), middle + new Vector(reach, 0, reach)))
            .Including(reach * Vector.I).Including(reach * Vector.J).Including(reach * Vector.K).Including(Vector.Zero);
    }

    /// <summary>Draws what the settings ask for over the scene's depths.</summary>
    /// <param name="view">Camera and projection.</param>
    /// <param name="aspect">Width divided by height of the viewport.</param>
    /// <param name="scene">Bounds of the scene: they decide the spacing.</param>
    /// <param name="settings">Which lines.</param>
    public void Draw(View view, double aspect, BoundingBox scene, RenderSettings settings)
    {
        if (!settings.Grid && !settings.Axes)
        {
            return;
        }

        var (spacing, middle) = Layout(scene);
        if (_uploads.IsNew(ref _last, (settings.Grid, settings.Axes, spacing, middle)))
        {
            Build(settings, spacing, middle);
        }

        Draw(view, aspect, BoundsWith(scene, settings), middle - view.Camera.Position);
    }

    /// <summary>Draws some lines in front of everything.</summary>
    /// <param name="view">Camera and projection.</param>
    /// <param name="aspect">Width divided by height of the viewport.</param>
    /// <param name="bounds">Of everything there is.</param>
    /// <param name="segments">The lines.</param>
    public void Draw(View view, double aspect, BoundingBox bounds, IReadOnlyList<LineSegment> segments)
    {
        if (segments.Count == 0)
        {
            return;
        }

        // In the buffer of the grid, which is built again when it is asked for next.
        _last = null;
        _data.Clear();
        foreach (var (from, to, colour) in segments)
        {
            Add(from - view.Camera.Position, to - view.Camera.Position, colour, 1, 1);
        }

        _lines.Upload<float>(CollectionsMarshal.AsSpan(_data), BufferUsageHint.StreamDraw);
        // They lead through what they tell of.
        GL.Disable(EnableCap.DepthTest);
        Draw(view, aspect, bounds, Vector.Zero);
        GL.Enable(EnableCap.DepthTest);
    }

    /// <inheritdoc/>
    public void Dispose()
    {
        _array.Dispose();
        _lines.Dispose();
        _program.Dispose();
    }

    private void Draw(View view, double aspect, BoundingBox bounds, Vector offset)
    {
        _program.Use();
        _view.Set(view, aspect, bounds);
        GL.Uniform3(_offset, (float)offset.X, (float)offset.Y, (float)offset.Z);
        GL.Enable(EnableCap.Blend);
        GL.BlendFuncSeparate(
            BlendingFactorSrc.SrcAlpha, BlendingFactorDest.OneMinusSrcAlpha, BlendingFactorSrc.Zero, BlendingFactorDest.One);
        GL.DepthMask(false);
        _array.Bind();
        GL.DrawArrays(PrimitiveType.Lines, 0, _data.Count / Floats);
        GL.DepthMask(true);
        GL.Disable(EnableCap.Blend);
    }

    /// <summary>A power of ten as spacing, so that the grid reaches beyond the scene, and a grid point near its middle.</summary>
    private static (double Spacing, Vector Middle) Layout(BoundingBox scene)
    {
        var size = scene.Diagonal is > 0 and < double.PositiveInfinity and var diagonal ? diagonal : 10;
        var spacing = Math.Pow(10, Math.Ceiling(Math.Log10(size / GridLines)));
        var centre = scene.Centre.IsFinite() ? scene.Centre : Vector.Zero;
        return (spacing, new(10 * spacing * Math.Round(centre.X / (10 * spacing)), 0, 10 * spacing * Math.Round(centre.Z / (10 * spacing))));
    }

    private void Build(RenderSettings settings, double spacing, Vector middle)
    {
        _data.Clear();
        if (settings.Grid)
        {
            AddGrid(spacing);
        }

        if (settings.Axes)
        {
            var length = GridLines * spacing;
            Add(-middle, (length * Vector.I) - middle, new(0.92, 0.30, 0.30), 1, 1);
            Add(-middle, (length * Vector.J) - middle, new(0.45, 0.80, 0.35), 1, 1);
            Add(-middle, (length * Vector.K) - middle, new(0.35, 0.55, 0.95), 1, 1);
        }

        _lines.Upload<float>(CollectionsMarshal.AsSpan(_data), BufferUsageHint.StaticDraw);
    }

    /// <summary>Lines that fade out towards the edge, in two halves each.</summary>
    private void AddGrid(double spacing)
    {
        var grey = new Colour(0.72, 0.76, 0.82);
        for (var i = -GridLines; i <= GridLines; i++)
        {
            var opacity = (i % 10 == 0 ? 0.42 : 0.16) * (1 - (Math.Abs(i) / (GridLines + 1.0)));
            var (at, end) = (i * spacing, GridLines * spacing);
            foreach (var side in (ReadOnlySpan<double>)[-end, end])
            {
                Add(new(at, 0, 0), new(at, 0, side), grey, opacity, 0);
                Add(new(0, 0, at), new(side, 0, at), grey, opacity, 0);
            }
        }
    }

    private void Add(Vector from, Vector to, Colour colour, double opacityFrom, double opacityTo)
    {
        Add(from, colour, opacityFrom);
        Add(to, colour, opacityTo);
    }

    private void Add(Vector point, Colour colour, double opacity)
    {
        var (red, green, blue) = colour.ToLinear();
        _data.AddRange([(float)point.X, (float)point.Y, (float)point.Z, (float)red, (float)green, (float)blue, (float)opacity]);
    }
}
