using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Gl;

/// <summary>A texture that frames are drawn into, read texel by texel.</summary>
internal sealed class FrameTexture : Texture2D
{
    /// <summary>Allocates a texture of one level.</summary>
    /// <param name="resources">Resources of the current context.</param>
    /// <param name="label">Name of the texture, for messages.</param>
    /// <param name="width">Width in texels.</param>
    /// <param name="height">Height in texels.</param>
    /// <param name="format">Format in which the GPU stores it.</param>
    public FrameTexture(GlResources resources, string label, int width, int height, PixelInternalFormat format)
        : base(resources, label)
    {
        Bind();
        GL.TexImage2D(TextureTarget.Texture2D, 0, format, width, height, 0, PixelFormat.Rgba, PixelType.UnsignedByte, IntPtr.Zero);
        GL.TexParameter(TextureTarget.Texture2D, TextureParameterName.TextureMaxLevel, 0);
    }

    /// <summary>Makes this the colour of the bound framebuffer.</summary>
    public void Attach() => GL.FramebufferTexture2D(
        FramebufferTarget.Framebuffer, FramebufferAttachment.ColorAttachment0, TextureTarget.Texture2D, Name, 0);
}
