using System.Runtime.InteropServices;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Ui.Overlays;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Ui.Drawing;

/// <summary>Glyphs and plain rectangles that are drawn over a frame in one call. They stay on the GPU until they are replaced.</summary>
internal sealed class QuadBatch : IDisposable
{
    private readonly GlResources _resources;
    private readonly ShaderProgram _program;
    private readonly GlBuffer _quadBuffer;
    private readonly VertexArray _vertexArray;
    private AlphaTexture? _glyphTexture;
    private GlyphSheet? _sheet;
    private int _quadCount;

    /// <summary>Builds the program of an empty batch.</summary>
    public QuadBatch(GlResources resources)
    {
        _resources = resources;
        _program = new(resources, "overlay");
        _program.Use();
        _program.Set("glyphs", 0);
        _program.Set("columns", GlyphSheet.Columns);
        _quadBuffer = new(resources, "overlay", BufferTarget.ArrayBuffer);
        _vertexArray = new(resources, "overlay");
        _vertexArray.Attribute(_quadBuffer, 0, 4, OverlayQuad.FloatsPerQuad, 0, divisor: 1);
        _vertexArray.Attribute(_quadBuffer, 1, 4, OverlayQuad.FloatsPerQuad, 4, divisor: 1);
        _vertexArray.Attribute(_quadBuffer, 2, 2, OverlayQuad.FloatsPerQuad, 8, divisor: 1);
        _vertexArray.Unbind();
    }

    /// <summary>Replaces all rectangles of the batch.</summary>
    /// <param name="quads">Rectangles in drawing order.</param>
    /// <param name="sheet">Sheet of their glyphs.</param>
    /// <param name="width">Width of the frame in pixels.</param>
    /// <param name="height">Height of the frame in pixels.</param>
    public void Upload(List<OverlayQuad> quads, GlyphSheet sheet, int width, int height)
    {
        _program.Use();
        _program.Set("frameSize", width, height);
        if (_sheet != sheet)
        {
            UseSheet(sheet);
        }

        _quadCount = quads.Count;
        _quadBuffer.Upload<OverlayQuad>(CollectionsMarshal.AsSpan(quads), BufferUsageHint.DynamicDraw);
    }

    /// <summary>Draws the rectangles into the bound framebuffer.</summary>
    public void Draw()
    {
        if (_quadCount == 0)
        {
            return;
        }

        _program.Use();
        _glyphTexture!.Bind();
        // Blended in sRGB as the eye compares: text that is blended in linear light looks too thin on a dark ground.
        GL.Disable(EnableCap.FramebufferSrgb);
        GlState.BeginBlending(BlendingFactorSrc.SrcAlpha);
        _vertexArray.Bind();
        GL.DrawArraysInstanced(PrimitiveType.TriangleStrip, 0, 4, _quadCount);
        GL.Disable(EnableCap.Blend);
    }

    /// <inheritdoc/>
    public void Dispose() => GlObject.DisposeAll(_glyphTexture, _vertexArray, _quadBuffer, _program);

    private void UseSheet(GlyphSheet sheet)
    {
        _glyphTexture?.Dispose();
        _glyphTexture = new(
            _resources, "glyphs", GlyphSheet.Columns * sheet.CellWidth, sheet.Rows * sheet.CellHeight, sheet.ToTexels());
        _sheet = sheet;
        GL.Uniform2(_program.UniformLocation("cellSize"), sheet.CellWidth, sheet.CellHeight);
    }
}
