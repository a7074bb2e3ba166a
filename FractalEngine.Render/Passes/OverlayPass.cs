using System.Runtime.InteropServices;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Ui;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Passes;

/// <summary>Draws panels of text over a picture, all of them in one call. Laid out and uploaded again only when they differ.</summary>
internal sealed class OverlayPass : IDisposable
{
    private readonly GlResources _resources;
    private readonly GlyphAtlas _atlas = GlyphAtlas.Load();
    private readonly ShaderProgram _program;
    private readonly int _pictureSize;
    private readonly int _cell;
    private readonly GlBuffer _quads;
    private readonly VertexArray _array;
    private AlphaTexture? _glyphs;
    private int _sheet = -1;
    private int _quadCount;
    private (OverlayPanel[] Panels, int Width, int Height)? _last;

    /// <summary>Builds the program and reads the font.</summary>
    public OverlayPass(GlResources resources)
    {
        _resources = resources;
        _program = ShaderProgram.Load(resources, "overlay");
        _pictureSize = _program.Uniform("pictureSize");
        _cell = _program.Uniform("cell");
        _program.Use();
        GL.Uniform1(_program.Uniform("glyphs"), 0);
        GL.Uniform1(_program.Uniform("columns"), GlyphSheet.Columns);
        _quads = new(resources, "overlay", BufferTarget.ArrayBuffer);
        _array = new(resources, "overlay");
        _array.Attribute(_quads, 0, 4, OverlayQuad.Floats, 0, divisor: 1);
        _array.Attribute(_quads, 1, 4, OverlayQuad.Floats, 4, divisor: 1);
        _array.Attribute(_quads, 2, 2, OverlayQuad.Floats, 8, divisor: 1);
        _array.Unbind();
    }

    /// <summary>Draws panels into the bound framebuffer.</summary>
    /// <param name="panels">None draws nothing.</param>
    /// <param name="width">Of the framebuffer, pixels.</param>
    /// <param name="height">Of the framebuffer, pixels.</param>
    public void Draw(IReadOnlyList<OverlayPanel> panels, int width, int height)
    {
        if (panels.Count == 0)
        {
            return;
        }

        Update(panels, width, height);
        _program.Use();
        _glyphs!.Bind();
        // Blended as the eye compares: text blended in linear light looks too thin on dark ground.
        GL.Disable(EnableCap.FramebufferSrgb);
        GL.Enable(EnableCap.Blend);
        GL.BlendFuncSeparate(
            BlendingFactorSrc.SrcAlpha, BlendingFactorDest.OneMinusSrcAlpha, BlendingFactorSrc.Zero, BlendingFactorDest.One);
        _array.Bind();
        GL.DrawArraysInstanced(PrimitiveType.TriangleStrip, 0, 4, _quadCount);
        GL.Disable(EnableCap.Blend);
    }

    /// <inheritdoc/>
    public void Dispose()
    {
        _glyphs?.Dispose();
        _array.Dispose();
        _quads.Dispose();
        _program.Dispose();
    }

    private void Update(IReadOnlyList<OverlayPanel> panels, int width, int height)
    {
        if (_last is { } last && (last.Width, last.Height) == (width, height) && last.Panels.SequenceEqual(panels))
        {
            return;
        }

        var layout = OverlayLayout.Of(_atlas, panels, width, height);
        var sheet = _atlas.Sheets[layout.SheetIndex];
        _program.Use();
        GL.Uniform2(_pictureSize, (float)width, height);
        if (_sheet != layout.SheetIndex)
        {
            _glyphs?.Dispose();
            _glyphs = new(_resources, "glyphs", GlyphSheet.Columns * sheet.CellWidth, sheet.Rows * sheet.CellHeight, sheet.Arranged());
            _sheet = layout.SheetIndex;
            GL.Uniform2(_cell, sheet.CellWidth, sheet.CellHeight);
        }

        _quadCount = layout.Quads.Count;
        _quads.Upload<OverlayQuad>(CollectionsMarshal.AsSpan(layout.Quads), BufferUsageHint.DynamicDraw);
        _last = ([.. panels], width, height);
    }
}
