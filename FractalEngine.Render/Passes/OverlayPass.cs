using System.Runtime.InteropServices;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Ui;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Passes;

/// <summary>Draws all panels of text over a frame in one call. They are laid out and uploaded again only when they differ.</summary>
internal sealed class OverlayPass : IDisposable
{
    private readonly GlResources _resources;
    private readonly GlyphAtlas _atlas = GlyphAtlas.Load();
    private readonly ShaderProgram _program;
    private readonly int _frameSizeLocation;
    private readonly int _cellSizeLocation;
    private readonly GlBuffer _quadBuffer;
    private readonly VertexArray _vertexArray;
    private AlphaTexture? _glyphTexture;
    private int _sheetIndex = -1;
    private int _quadCount;
    private (OverlayPanel[] Panels, int Width, int Height)? _lastKey;

    /// <summary>Builds the program and reads the font.</summary>
    public OverlayPass(GlResources resources)
    {
        _resources = resources;
        _program = ShaderProgram.Load(resources, "overlay");
        _frameSizeLocation = _program.UniformLocation("frameSize");
        _cellSizeLocation = _program.UniformLocation("cellSize");
        _program.Use();
        GL.Uniform1(_program.UniformLocation("glyphs"), 0);
        GL.Uniform1(_program.UniformLocation("columns"), GlyphSheet.Columns);
        _quadBuffer = new(resources, "overlay", BufferTarget.ArrayBuffer);
        _vertexArray = new(resources, "overlay");
        _vertexArray.Attribute(_quadBuffer, 0, 4, OverlayQuad.FloatsPerQuad, 0, divisor: 1);
        _vertexArray.Attribute(_quadBuffer, 1, 4, OverlayQuad.FloatsPerQuad, 4, divisor: 1);
        _vertexArray.Attribute(_quadBuffer, 2, 2, OverlayQuad.FloatsPerQuad, 8, divisor: 1);
        _vertexArray.Unbind();
    }

    /// <summary>Draws panels into the bound framebuffer.</summary>
    /// <param name="panels">Panels to draw; none draws nothing.</param>
    /// <param name="width">Width of the framebuffer in pixels.</param>
    /// <param name="height">Height of the framebuffer in pixels.</param>
    public void Draw(IReadOnlyList<OverlayPanel> panels, int width, int height)
    {
        if (panels.Count == 0)
        {
            return;
        }

        Update(panels, width, height);
        _program.Use();
        _glyphTexture!.Bind();
        // Blended in sRGB as the eye compares: text that is blended in linear light looks too thin on a dark ground.
        GL.Disable(EnableCap.FramebufferSrgb);
        GL.Enable(EnableCap.Blend);
        GL.BlendFuncSeparate(
            BlendingFactorSrc.SrcAlpha, BlendingFactorDest.OneMinusSrcAlpha, BlendingFactorSrc.Zero, BlendingFactorDest.One);
        _vertexArray.Bind();
        GL.DrawArraysInstanced(PrimitiveType.TriangleStrip, 0, 4, _quadCount);
        GL.Disable(EnableCap.Blend);
    }

    /// <inheritdoc/>
    public void Dispose()
    {
        _glyphTexture?.Dispose();
        _vertexArray.Dispose();
        _quadBuffer.Dispose();
        _program.Dispose();
    }

    private void Update(IReadOnlyList<OverlayPanel> panels, int width, int height)
    {
        if (_lastKey is { } last && (last.Width, last.Height) == (width, height) && last.Panels.SequenceEqual(panels))
        {
            return;
        }

        var layout = OverlayLayout.Create(_atlas, panels, width, height);
        _program.Use();
        GL.Uniform2(_frameSizeLocation, (float)width, height);
        if (_sheetIndex != layout.SheetIndex)
        {
            UseSheet(layout.SheetIndex);
        }

        _quadCount = layout.Quads.Count;
        _quadBuffer.Upload<OverlayQuad>(CollectionsMarshal.AsSpan(layout.Quads), BufferUsageHint.DynamicDraw);
        _lastKey = ([.. panels], width, height);
    }

    private void UseSheet(int index)
    {
        var sheet = _atlas.Sheets[index];
        _glyphTexture?.Dispose();
        _glyphTexture = new(
            _resources, "glyphs", GlyphSheet.Columns * sheet.CellWidth, sheet.Rows * sheet.CellHeight, sheet.ToTexels());
        _sheetIndex = index;
        GL.Uniform2(_cellSizeLocation, sheet.CellWidth, sheet.CellHeight);
    }
}
