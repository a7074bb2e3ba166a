using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Gl.State;

/// <summary>
/// Tracks the bindings of one context. Programs, vertex arrays, textures, uniform buffers and the culled face are set only through this
/// class, so that a binding that is in effect is not made again.
/// </summary>
internal sealed class GlState
{
    /// <summary>Number of binding points for uniform buffers.</summary>
    public const int UniformBindingCount = 3;

    /// <summary>Binding point of the uniform block <c>ObjectBlock</c>.</summary>
    public const int ObjectBinding = 0;

    /// <summary>Binding point of the uniform block <c>LightBlock</c>.</summary>
    public const int LightBinding = 1;

    /// <summary>Binding point of the uniform block <c>ShadowBlock</c>.</summary>
    public const int ShadowBinding = 2;

    /// <summary>Texture unit of the depth maps.</summary>
    public const int ShadowTextureUnit = 1;

    /// <summary>Texture unit of the part of light that facets mirror.</summary>
    public const int FacetTextureUnit = 2;

    /// <summary>Texture unit of the light from all around.</summary>
    public const int SurroundingsTextureUnit = 3;

    /// <summary>Texture unit of the normals or heights of a surface.</summary>
    public const int DetailTextureUnit = 4;

    /// <summary>Texture unit of a frame that something is added to.</summary>
    public const int FrameTextureUnit = 5;

    /// <summary>Texture unit of the depths of a frame.</summary>
    public const int DepthTextureUnit = 6;

    /// <summary>Texture unit of the light that the air scatters.</summary>
    public const int AirTextureUnit = 7;

    /// <summary>Texture unit of the colours of a reflection probe.</summary>
    public const int ProbeTextureUnit = 8;

    /// <summary>Texture unit of the depths of a reflection probe.</summary>
    public const int ProbeDepthTextureUnit = 9;

    // No GL object has this name, and no face this value, so that the next call always takes effect.
    private const int Unknown = -1;

    private readonly int[] _uniformBuffers = [.. Enumerable.Repeat(Unknown, UniformBindingCount)];
    private int _program = Unknown;
    private int _vertexArray = Unknown;
    private int _texture = Unknown;
    private CullFace _culledFace = (CullFace)Unknown;

    /// <summary>Counts bindings and program uniforms, and skips redundant ones.</summary>
    public RedundancyFilter Filter { get; } = new();

    /// <summary>Makes a program current.</summary>
    public void UseProgram(int name)
    {
        if (Filter.Update(ref _program, name))
        {
            GL.UseProgram(name);
        }
    }

    /// <summary>Number of calls that have drawn triangles since the context was opened.</summary>
    public long DrawCallCount { get; set; }

    /// <summary>Makes a vertex array current; 0 for none.</summary>
    public void BindVertexArray(int name)
    {
        if (Filter.Update(ref _vertexArray, name))
        {
            GL.BindVertexArray(name);
        }
    }

    /// <summary>Binds a two-dimensional texture to the first texture unit.</summary>
    public void BindTexture(int name)
    {
        if (Filter.Update(ref _texture, name))
        {
            GL.ActiveTexture(TextureUnit.Texture0);
            GL.BindTexture(TextureTarget.Texture2D, name);
        }
    }

    /// <summary>Binds a texture to a texture unit other than the first, whatever is bound there.</summary>
    public static void BindTexture(int unit, int name, TextureTarget kind = TextureTarget.Texture2D)
    {
        GL.ActiveTexture(TextureUnit.Texture0 + unit);
        GL.BindTexture(kind, name);
        GL.ActiveTexture(TextureUnit.Texture0);
    }

    /// <summary>Binds a uniform buffer to a binding point.</summary>
    /// <param name="bindingPoint">Index below <see cref="UniformBindingCount"/>.</param>
    /// <param name="name">Name of the buffer.</param>
    public void BindUniformBuffer(int bindingPoint, int name)
    {
        if (Filter.Update(ref _uniformBuffers[bindingPoint], name))
        {
            GL.BindBufferBase(BufferRangeTarget.UniformBuffer, bindingPoint, name);
        }
    }

    /// <summary>Selects the face of triangles that is not drawn.</summary>
    public void Cull(CullFace face)
    {
        if (!Filter.Update(ref _culledFace, face))
        {
            return;
        }

        if (face == CullFace.None)
        {
            GL.Disable(EnableCap.CullFace);
        }
        else
        {
            GL.Enable(EnableCap.CullFace);
            GlShim.SetCulledFace(face);
        }
    }

    /// <summary>Blends what follows over the frame, whose opacity stays, until blending is disabled.</summary>
    /// <param name="factor">What colours are multiplied by: their opacity, or one where that has happened already.</param>
    public static void BeginBlending(BlendingFactorSrc factor)
    {
        GL.Enable(EnableCap.Blend);
        GL.BlendFuncSeparate(factor, BlendingFactorDest.OneMinusSrcAlpha, BlendingFactorSrc.Zero, BlendingFactorDest.One);
    }

    /// <summary>Deletes a program. GL may give its name to a new program.</summary>
    public void DeleteProgram(int name)
    {
        GL.DeleteProgram(name);
        Invalidate(ref _program, name);
    }

    /// <summary>Deletes a vertex array and forgets its binding.</summary>
    public void DeleteVertexArray(int name)
    {
        GL.DeleteVertexArray(name);
        Invalidate(ref _vertexArray, name);
    }

    /// <summary>Deletes a texture and forgets its binding.</summary>
    public void DeleteTexture(int name)
    {
        GL.DeleteTexture(name);
        Invalidate(ref _texture, name);
    }

    /// <summary>Deletes a buffer of any kind and forgets its bindings.</summary>
    public void DeleteBuffer(int name)
    {
        GL.DeleteBuffer(name);
        foreach (ref var bound in _uniformBuffers.AsSpan())
        {
            Invalidate(ref bound, name);
        }
    }

    private static void Invalidate(ref int bound, int name) => bound = bound == name ? Unknown : bound;

    /// <summary>Returns the back faces of a solid, by the sign of its triangles' winding; none for 0.</summary>
    public static CullFace BackFacesOf(int windingSign) =>
        windingSign == 0 ? CullFace.None : windingSign < 0 ? CullFace.Front : CullFace.Back;
}
