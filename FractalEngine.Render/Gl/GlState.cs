using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Gl;

/// <summary>
/// What is bound in one context. Programs, vertex arrays, textures, uniform buffers and the side that is left out are set here and nowhere
/// else, so that what is bound already is not bound again.
/// </summary>
internal sealed class GlState
{
    /// <summary>Binding points of uniform buffers.</summary>
    public const int UniformBindingCount = 2;

    // No object has this name: the next binding is made.
    private const int Unknown = -1;

    private readonly int[] _uniformBuffers = [.. Enumerable.Repeat(Unknown, UniformBindingCount)];
    private int _program = Unknown;
    private int _vertexArray = Unknown;
    private int _texture = Unknown;
    private (bool IsKnown, bool? Front) _culledFace;

    /// <summary>Made and not needed: bindings, and uniforms of programs.</summary>
    public RedundancyFilter Filter { get; } = new();

    /// <summary>Makes a program current.</summary>
    public void UseProgram(int name)
    {
        if (Filter.Update(ref _program, name))
        {
            GL.UseProgram(name);
        }
    }

    /// <summary>Makes a vertex array current; 0 for none.</summary>
    public void BindVertexArray(int name)
    {
        if (Filter.Update(ref _vertexArray, name))
        {
            GL.BindVertexArray(name);
        }
    }

    /// <summary>Binds a texture of two dimensions to the first texture unit.</summary>
    public void BindTexture(int name)
    {
        if (Filter.Update(ref _texture, name))
        {
            GL.ActiveTexture(TextureUnit.Texture0);
            GL.BindTexture(TextureTarget.Texture2D, name);
        }
    }

    /// <summary>Binds a uniform buffer.</summary>
    /// <param name="bindingPoint">Below <see cref="UniformBindingCount"/>.</param>
    /// <param name="name">Of the buffer.</param>
    public void BindUniformBuffer(int bindingPoint, int name)
    {
        if (Filter.Update(ref _uniformBuffers[bindingPoint], name))
        {
            GL.BindBufferBase(BufferRangeTarget.UniformBuffer, bindingPoint, name);
        }
    }

    /// <summary>Chooses which side of triangles is not drawn.</summary>
    /// <param name="culledFace">True for the front, false for the back; null to draw both.</param>
    public void Cull(bool? culledFace)
    {
        if (!Filter.Update(ref _culledFace, (true, culledFace)))
        {
            return;
        }

        if (culledFace is { } isFront)
        {
            GL.Enable(EnableCap.CullFace);
            GlShim.SetCulledFace(isFront);
        }
        else
        {
            GL.Disable(EnableCap.CullFace);
        }
    }

    /// <summary>Deletes a program. Its name may come again, for another one.</summary>
    public void DeleteProgram(int name)
    {
        GL.DeleteProgram(name);
        Invalidate(ref _program, name);
    }

    /// <summary>Deletes a vertex array.</summary>
    public void DeleteVertexArray(int name)
    {
        GL.DeleteVertexArray(name);
        Invalidate(ref _vertexArray, name);
    }

    /// <summary>Deletes a texture.</summary>
    public void DeleteTexture(int name)
    {
        GL.DeleteTexture(name);
        Invalidate(ref _texture, name);
    }

    /// <summary>Deletes a buffer of any kind.</summary>
    public void DeleteBuffer(int name)
    {
        GL.DeleteBuffer(name);
        foreach (ref var bound in _uniformBuffers.AsSpan())
        {
            Invalidate(ref bound, name);
        }
    }

    private static void Invalidate(ref int bound, int name) => bound = bound == name ? Unknown : bound;
}
