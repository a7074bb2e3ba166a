using FractalEngine.Render.Gl.State;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Gl;

/// <summary>A texture of numbers of 32 bits, filtered linearly within its levels and between them.</summary>
internal sealed class FloatTexture : Texture2D
{
    /// <summary>Uploads all levels. Coordinates repeat along rows, and end at the first and the last row.</summary>
    /// <param name="resources">Resources of the current context.</param>
    /// <param name="label">Name of the texture, for messages.</param>
    /// <param name="width">Width of the first level in texels. That of each further one is half of it, and at least 1.</param>
    /// <param name="height">Height of the first level in texels, halved likewise.</param>
    /// <param name="levels">Texels of each level, [height × width × 3].</param>
    /// <exception cref="GlException">The memory does not suffice.</exception>
    public FloatTexture(GlResources resources, string label, int width, int height, float[][] levels)
        : base(resources, label)
    {
        DisposeOnFailure(this, () =>
        {
            Bind();
            for (var level = 0; level < levels.Length; level++)
            {
                GL.TexImage2D(
                    TextureTarget.Texture2D, level, PixelInternalFormat.Rgb32f, Math.Max(1, width >> level), Math.Max(1, height >> level),
                    0, PixelFormat.Rgb, PixelType.Float, levels[level]);
            }

            Set(TextureParameterName.TextureMaxLevel, levels.Length - 1);
            Set(TextureParameterName.TextureMinFilter, (int)TextureMinFilter.LinearMipmapLinear);
            Set(TextureParameterName.TextureMagFilter, (int)TextureMagFilter.Linear);
            Set(TextureParameterName.TextureWrapT, (int)TextureWrapMode.ClampToEdge);
            Resources.ThrowOnError($"{this} of {width}×{height} texels");
        });

        static void Set(TextureParameterName parameter, int value) => GL.TexParameter(TextureTarget.Texture2D, parameter, value);
    }
}
