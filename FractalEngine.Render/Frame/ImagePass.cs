using FractalEngine.Core.Images;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Views;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Frame;

/// <summary>Blends an image over a frame in linear light. An image of bytes is uploaded again only when it is another one.</summary>
internal sealed class ImagePass : IDisposable
{
    private readonly GlResources _resources;
    private readonly ShaderProgram _program;
    private readonly VertexArray _vertexArray;
    private SurfaceTexture? _texture;
    private PixelImage? _image;

    /// <summary>Builds the program that draws images.</summary>
    public ImagePass(GlResources resources)
    {
        _resources = resources;
        _program = new(resources, "image");
        _program.Use();
        _program.Set("image", 0);
        // The vertices have no attributes, but OpenGL requires an array.
        _vertexArray = new(resources, "image");
    }

    /// <summary>Draws an image into the bound framebuffer, which has its size.</summary>
    /// <exception cref="GlException">The GPU's memory does not suffice.</exception>
    public void Draw(ImageLayer layer)
    {
        if (layer.Image != _image)
        {
            _texture?.Dispose();
            _texture = null;
            _image = null;
            _texture = new(_resources, "image over the frame", layer.Image);
            _image = layer.Image;
        }

        _texture!.Bind(isClamped: true);
        Blend(layer.Opacity, isTopFirst: true);
    }

    /// <summary>Draws another frame into the bound framebuffer, which has its size.</summary>
    /// <param name="frame">The frame.</param>
    /// <param name="opacity">From 0 to 1.</param>
    public void Draw(FrameTexture frame, double opacity)
    {
        frame.Bind();
        Blend(opacity, isTopFirst: false);
    }

    private void Blend(double opacity, bool isTopFirst)
    {
        _program.Use();
        _program.Set("opacity", opacity);
        _program.Set("isTopFirst", isTopFirst ? 1 : 0);
        _resources.State.Cull(CullFace.None);
        GL.Enable(EnableCap.FramebufferSrgb);
        GlState.BeginBlending(BlendingFactorSrc.SrcAlpha);
        _vertexArray.Bind();
        GL.DrawArrays(PrimitiveType.Triangles, 0, 3);
        GL.Disable(EnableCap.Blend);
    }

    /// <inheritdoc/>
    public void Dispose() => GlObject.DisposeAll(_texture, _vertexArray, _program);
}
