using System.Runtime.InteropServices;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Upload;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Frame;

/// <summary>Draws the ground grid on y = 0, the three axes, and line segments over the scene.</summary>
internal sealed class LinesPass : IDisposable
{
    private const int FloatsPerVertex = 7;

    // Grid lines on each side of the centre; every tenth is stronger.
    private const int GridLinesPerSide = 20;

    private readonly RedundancyFilter _uploadFilter;
    private readonly ShaderProgram _program;
    private readonly ViewUniforms _viewUniforms;
    private readonly GlBuffer _vertices;
    private readonly VertexArray _vertexArray;
    private readonly List<float> _data = [];
    private (bool Grid, bool Axes, double Spacing, Vector Centre)? _lastKey;

    /// <summary>Builds the program and an empty vertex buffer.</summary>
    public LinesPass(RenderContext context)
    {
        _uploadFilter = context.Resources.UploadFilter;
        _program = new(context.Resources, "lines");
        _viewUniforms = new(_program, context.Resources.State.Filter, context.HasReversedDepth);
        _vertices = new(context.Resources, "grid and axes", BufferTarget.ArrayBuffer);
        _vertexArray = new(context.Resources, "grid and axes");
        _vertexArray.Attribute(_vertices, 0, 3, FloatsPerVertex, 0);
        _vertexArray.Attribute(_vertices, 1, 4, FloatsPerVertex, 3);
        _vertexArray.Unbind();
    }

    /// <summary>Returns the bounds of a scene together with the grid and the axes, where the settings ask for them.</summary>
    public static BoundingBox BoundsIncludingLines(BoundingBox sceneBounds, RenderSettings settings)
    {
        if (!settings.Grid && !settings.Axes)
        {
            return sceneBounds;
        }

        var (spacing, gridCentre) = GridLayout(sceneBounds);
        var gridHalfSize = GridLinesPerSide * spacing;
        var gridCorner = new Vector(gridHalfSize, 0, gridHalfSize);
        return BoundingBox.Union(sceneBounds, new(gridCentre - gridCorner, gridCentre + gridCorner))
            .Including(gridHalfSize * Vector.I).Including(gridHalfSize * Vector.J).Including(gridHalfSize * Vector.K)
            .Including(Vector.Zero);
    }

    /// <summary>Draws the grid and the axes that the settings ask for, hidden by nearer surfaces.</summary>
    /// <param name="frame">View of the frame.</param>
    /// <param name="sceneBounds">Bounds of the scene, which decide the spacing.</param>
    /// <param name="settings">Settings that switch grid and axes on.</param>
    public void DrawGridAndAxes(in FrameView frame, BoundingBox sceneBounds, RenderSettings settings)
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

        DrawVertices(in frame, gridCentre - frame.View.Camera.Position);
    }

    /// <summary>Draws line segments in front of all surfaces.</summary>
    /// <param name="frame">View of the frame.</param>
    /// <param name="segments">Lines to draw; none draws nothing.</param>
    public void DrawSegments(in FrameView frame, IReadOnlyList<LineSegment> segments)
    {
        if (segments.Count == 0)
        {
            return;
        }

        // The grid's buffer is reused, and built again when the grid is drawn next.
        _lastKey = null;
        _data.Clear();
        var cameraPosition = frame.View.Camera.Position;
        foreach (var (from, to, colour) in segments)
        {
            AddLine(from - cameraPosition, to - cameraPosition, colour, 1, 1);
        }

        _vertices.Upload<float>(CollectionsMarshal.AsSpan(_data), BufferUsageHint.StreamDraw);
        // The segments lead through the objects that they measure.
        GL.Disable(EnableCap.DepthTest);
        DrawVertices(in frame, Vector.Zero);
        GL.Enable(EnableCap.DepthTest);
    }

    /// <inheritdoc/>
    public void Dispose() => GlObject.DisposeAll(_vertexArray, _vertices, _program);

    private void DrawVertices(in FrameView frame, Vector offset)
    {
        _program.Use();
        _viewUniforms.Set(in frame);
        _program.Set("offset", offset);
        GlState.BeginBlending(BlendingFactorSrc.SrcAlpha);
        GL.DepthMask(false);
        _vertexArray.Bind();
        GL.DrawArrays(PrimitiveType.Lines, 0, _data.Count / FloatsPerVertex);
        GL.DepthMask(true);
        GL.Disable(EnableCap.Blend);
    }

    /// <summary>Returns a power of ten as spacing, so that the grid exceeds the scene, and a grid point near its centre.</summary>
    private static (double Spacing, Vector Centre) GridLayout(BoundingBox sceneBounds)
    {
        var size = sceneBounds.FiniteDiagonalOr(10);
        var spacing = Math.Pow(10, Math.Ceiling(Math.Log10(size / GridLinesPerSide)));
        var sceneCentre = sceneBounds.Centre.IsFinite() ? sceneBounds.Centre : Vector.Zero;
        return (spacing, new(RoundToTenth(sceneCentre.X, spacing), 0, RoundToTenth(sceneCentre.Z, spacing)));
    }

    /// <summary>Rounds a coordinate to the closest stronger grid line.</summary>
    private static double RoundToTenth(double coordinate, double spacing) =>
        10 * spacing * Math.Round(coordinate / (10 * spacing));

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
            AddLine(-gridCentre, (length * Vector.I) - gridCentre, new(0.92, 0.30, 0.30), 1, 1);
            AddLine(-gridCentre, (length * Vector.J) - gridCentre, new(0.45, 0.80, 0.35), 1, 1);
            AddLine(-gridCentre, (length * Vector.K) - gridCentre, new(0.35, 0.55, 0.95), 1, 1);
        }

        _vertices.Upload<float>(CollectionsMarshal.AsSpan(_data), BufferUsageHint.StaticDraw);
    }

    /// <summary>Adds grid lines that fade out towards the edge, each in two halves.</summary>
    private void AddGrid(double spacing)
    {
        var grey = new Colour(0.72, 0.76, 0.82);
        var end = GridLinesPerSide * spacing;
        for (var i = -GridLinesPerSide; i <= GridLinesPerSide; i++)
        {
            var opacity = (i % 10 == 0 ? 0.42 : 0.16) * (1 - (Math.Abs(i) / (GridLinesPerSide + 1.0)));
            var coordinate = i * spacing;
            foreach (var side in (ReadOnlySpan<double>)[-end, end])
            {
                AddLine(new(coordinate, 0, 0), new(coordinate, 0, side), grey, opacity, 0);
                AddLine(new(0, 0, coordinate), new(side, 0, coordinate), grey, opacity, 0);
            }
        }
    }

    private void AddLine(Vector from, Vector to, Colour colour, double opacityFrom, double opacityTo)
    {
        AddVertex(from, colour, opacityFrom);
        AddVertex(to, colour, opacityTo);
    }

    private void AddVertex(Vector point, Colour colour, double opacity)
    {
        var (red, green, blue) = colour.ToLinear();
        _data.AddRange([(float)point.X, (float)point.Y, (float)point.Z, (float)red, (float)green, (float)blue, (float)opacity]);
    }
}
