using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Gl;

/// <summary>The GL calls that the two assemblies named OpenTK spell differently.</summary>
internal static class GlShim
{
    /// <summary>Draws triangles as lines or filled.</summary>
    public static void SetWireframe(bool wireframe)
    {
        var mode = wireframe ? PolygonMode.Line : PolygonMode.Fill;
#if OPENTK_DEBIAN
        GL.PolygonMode(MaterialFace.FrontAndBack, mode);
#else
        GL.PolygonMode(TriangleFace.FrontAndBack, mode);
#endif
    }

    /// <summary>Leaves out the triangles of one side: of the front, or of the back.</summary>
    public static void SetCulledFace(bool front)
    {
#if OPENTK_DEBIAN
        GL.CullFace(front ? CullFaceMode.Front : CullFaceMode.Back);
#else
        GL.CullFace(front ? TriangleFace.Front : TriangleFace.Back);
#endif
    }
}
