using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Gl.State;

/// <summary>Wraps the GL calls that the two assemblies named OpenTK declare differently.</summary>
internal static class GlShim
{
    /// <summary>Draws triangles as edges, or filled.</summary>
    public static void SetWireframe(bool wireframe)
    {
        var mode = wireframe ? PolygonMode.Line : PolygonMode.Fill;
#if OPENTK_DEBIAN
        GL.PolygonMode(MaterialFace.FrontAndBack, mode);
#else
        GL.PolygonMode(TriangleFace.FrontAndBack, mode);
#endif
    }

    /// <summary>Selects the face that is culled while <see cref="EnableCap.CullFace"/> is enabled.</summary>
    /// <param name="face">Front or back face.</param>
    public static void SetCulledFace(CullFace face)
    {
#if OPENTK_DEBIAN
        GL.CullFace(face == CullFace.Front ? CullFaceMode.Front : CullFaceMode.Back);
#else
        GL.CullFace(face == CullFace.Front ? TriangleFace.Front : TriangleFace.Back);
#endif
    }
}
