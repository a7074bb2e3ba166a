using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Views;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Upload;

/// <summary>Sets the camera uniforms of a program, each only when it has changed.</summary>
internal sealed class ViewUniforms(ShaderProgram program, RedundancyFilter filter, bool hasReversedDepth)
{
    private readonly float[] _rows = new float[9];
    private Matrix? _lastAxes;
    private (double X, double Y) _lastScale;
    private (double ZByDepth, double Z, double WByDepth, double W) _lastDepth;

    /// <summary>Sets the uniforms that differ from the last call. The program must be in use.</summary>
    public void Set(in FrameView frame)
    {
        var view = frame.View;
        var axes = frame.AxesInverse;
        if (filter.Update(ref _lastAxes, axes))
        {
            WriteRows(axes, _rows);
            GL.Uniform3(program.UniformLocation("cameraAxes"), 3, _rows);
        }

        var halfHeight = view.HalfHeight;
        if (filter.Update(ref _lastScale, (1 / (halfHeight * frame.Aspect), 1 / halfHeight)))
        {
            program.Set("viewScale", _lastScale.X, _lastScale.Y);
        }

        if (filter.Update(ref _lastDepth, DepthScale(frame.Near, frame.Far, view.Projection == Projection.Perspective)))
        {
            program.Set("depthScale", _lastDepth.ZByDepth, _lastDepth.Z, _lastDepth.WByDepth, _lastDepth.W);
        }
    }

    /// <summary>
    /// Returns the coefficients of z = ZByDepth·depth + Z and w = WByDepth·depth + W. The near plane n and the far plane f map to z/w = −1
    /// and 1, or with reversed depth to 1 and 0.
    /// </summary>
    private (double ZByDepth, double Z, double WByDepth, double W) DepthScale(double near, double far, bool isPerspective)
    {
        if (isPerspective)
        {
            return hasReversedDepth
                ? (-near / (far - near), far * near / (far - near), 1, 0)
                : ((far + near) / (far - near), -2 * far * near / (far - near), 1, 0);
        }

        return hasReversedDepth
            ? (-1 / (far - near), far / (far - near), 0, 1)
            : (2 / (far - near), -(far + near) / (far - near), 0, 1);
    }

    /// <summary>Sets a uniform to a plane, so that the shader's distances are positive on the side that is kept.</summary>
    internal static void SetSection(int location, SectionPlane section) => GL.Uniform4(
        location, -(float)section.Normal.X, -(float)section.Normal.Y, -(float)section.Normal.Z, (float)section.Distance);

    /// <summary>Writes a matrix row by row.</summary>
    internal static void WriteRows(Matrix axes, Span<float> rows)
    {
        var (v1, v2, v3) = axes;
        (rows[0], rows[1], rows[2]) = ((float)v1.X, (float)v2.X, (float)v3.X);
        (rows[3], rows[4], rows[5]) = ((float)v1.Y, (float)v2.Y, (float)v3.Y);
        (rows[6], rows[7], rows[8]) = ((float)v1.Z, (float)v2.Z, (float)v3.Z);
    }
}
