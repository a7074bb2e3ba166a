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
    private const int FloatsPerVertex = 7;

    // Lines to each side of the middle; every tenth is stronger.
    private const int GridLinesPerSide = 20;

    private readonly RedundancyFilter _uploadFilter;
    private readonly ShaderProgram _program;
    private readonly ViewUniforms _viewUniforms;
    private readonly int _offsetLocation;
    private readonly GlBuffer _vertices;
    private readonly VertexArray _vertexArray;
    private readonly List<float> _data = [];
    private (bool Grid, bool Axes, double Spacing, Vector Middle)? _lastKey;

    /// <summary>Builds the program.</summary>
    public LinesPass(RenderContext context)
    {
        _uploadFilter = context.Resources.UploadFilter;
        _program = ShaderProgram.Load(context.Resources, "lines");
        _viewUniforms = new(_program, context.Resources.State.Filter, context.HasReversedDepth);
        _offsetLocation = _program.UniformLocation("offset");
        _vertices = new(context.Resources, "grid and axes", BufferTarget.ArrayBuffer);
        _vertexArray = new(context.Resources, "grid and axes");
        _vertexArray.Attribute(_vertices, 0, 3, FloatsPerVertex, 0);
        _vertexArray.Attribute(_vertices, 1, 4, FloatsPerVertex, 3);
        _vertexArray.Unbind();
    }

    /// <summary>What the lines reach beyond the scene, for planes that hold both.</summary>
    public static BoundingBox BoundsIncludingLines(BoundingBox sceneBounds, RenderSettings settings)
    {
        if (!settings.Grid && !settings.Axes)
        {
            return sceneBounds;
        }

        var (spacing, gridCentre) = GridLayout(sceneBounds);
        var gridHalfSize = GridLinesPerSide * spacing;
        return BoundingBox.Union(sceneBounds,
            new(gridCentre - new Vector(gridHalfSize, 0, gridHalfSize), gridCentre + new Vector(gridHalfSize, 0, gridHalfSize)))
            .Including(gridHalfSize * Vector.I).Including(gridHalfSize * Vector.J).Including(gridHalfSize * Vector.K)
            .Including(Vector.Zero);
    }

    /// <summary>Draws what the settings ask for over the scene's depths.</summary>
    /// <param name="view">Camera and projection.</param>
    /// <param name="aspect">Width divided by height of the viewport.</param>
    /// <param name="sceneBounds">Bounds of the scene: they decide the spacing.</param>
    /// <param name="settings">Which lines.</param>
    public void Draw(View view, double aspect, BoundingBox sceneBounds, RenderSettings settings)
    {
        if (!settings.Grid && !settings.Axes)
        {
            return;
        }

        var (spacing, gridCentre) = GridLayout(sceneBounds);
        if (_uploadFilter.Update(ref _lastKey, (settings.Grid, settings.Axes, spacing, gridCentre)))
        {
            BuildVertices(settings, spacing, gridCentre);
        }

        Draw(view, aspect, BoundsIncludingLines(sceneBounds, settings), gridCentre - view.Camera.Position);
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
        _lastKey = null;
        _data.Clear();
        foreach (var (from, to, colour) in segments)
        {
            Add(from - view.Camera.Position, to - view.Camera.Position, colour, 1, 1);
        }

        _vertices.Upload<float>(CollectionsMarshal.AsSpan(_data), BufferUsageHint.StreamDraw);
        // They lead through what they tell of.
        GL.Disable(EnableCap.DepthTest);
        Draw(view, aspect, bounds, Vector.Zero);
        GL.Enable(EnableCap.DepthTest);
    }

    /// <inheritdoc/>
    public void Dispose()
    {
        _vertexArray.Dispose();
        _vertices.Dispose();
        _program.Dispose();
    }

    private void Draw(View view, double aspect, BoundingBox bounds, Vector offset)
    {
        _program.Use();
        _viewUniforms.Set(view, aspect, bounds);
        GL.Uniform3(_offsetLocation, (float)offset.X, (float)offset.Y, (float)offset.Z);
        GL.Enable(EnableCap.Blend);
        GL.BlendFuncSeparate(
            BlendingFactorSrc.SrcAlpha, BlendingFactorDest.OneMinusSrcAlpha, BlendingFactorSrc.Zero, BlendingFactorDest.One);
        GL.DepthMask(false);
        _vertexArray.Bind();
        GL.DrawArrays(PrimitiveType.Lines, 0, _data.Count / FloatsPerVertex);
        GL.DepthMask(true);
        GL.Disable(EnableCap.Blend);
    }

    /// <summary>A power of ten as spacing, so that the grid reaches beyond the scene, and a grid point near its middle.</summary>
    private static (double Spacing, Vector Middle) GridLayout(BoundingBox sceneBounds)
    {
        var size = sceneBounds.Diagonal is > 0 and < double.PositiveInfinity and var diagonal ? diagonal : 10;
        var spacing = Math.Pow(10, Math.Ceiling(Math.Log10(size / GridLinesPerSide)));
        var centre = sceneBounds.Centre.IsFinite() ? sceneBounds.Centre : Vector.Zero;
        return (spacing,
            new(10 * spacing * Math.Round(centre.X / (10 * spacing)), 0, 10 * spacing * Math.Round(centre.Z / (10 * spacing))));
    }

    private void BuildVertices(RenderSettings settings, double spacing, Vector gridCentre)
    {
        _data.Clear();
        if (settings.Grid)
        {
            AddGrid(spacing);
        }

        if (settings.Axes)
        {
            var length = GridLinesPerSide * spacing;
            Add(-gridCentre, (length * Vector.I) - gridCentre, new(0.92, 0.30, 0.30), 1, 1);
            Add(-gridCentre, (length * Vector.J) - gridCentre, new(0.45, 0.80, 0.35), 1, 1);
            Add(-gridCentre, (length * Vector.K) - gridCentre, new(0.35, 0.55, 0.95), 1, 1);
        }

        _vertices.Upload<float>(CollectionsMarshal.AsSpan(_data), BufferUsageHint.StaticDraw);
    }

    /// <summary>Lines that fade out towards the edge, in two halves each.</summary>
    private void AddGrid(double spacing)
    {
        var grey = new Colour(0.72, 0.76, 0.82);
        for (var i = -GridLinesPerSide; i <= GridLinesPerSide; i++)
        {
            var opacity = (i % 10 == 0 ? 0.42 : 0.16) * (1 - (Math.Abs(i) / (GridLinesPerSide + 1.0)));
            var (coordinate, end) = (i * spacing, GridLinesPerSide * spacing);
            foreach (var side in (ReadOnlySpan<double>)[-end, end])
            {
                Add(new(coordinate, 0, 0), new(coordinate, 0, side), grey, opacity, 0);
                Add(new(0, 0, coordinate), new(side, 0, coordinate), grey, opacity, 0);
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
