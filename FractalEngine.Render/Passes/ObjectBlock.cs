using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Gl;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Passes;

/// <summary>
/// The paper's matrix m of one object in a buffer of its own (§4.3.1), with its colour; laid out as <c>ObjectBlock</c> in mesh.vert
/// (std140). The translation is relative to the camera, subtracted in double precision, so that far from the origin nothing trembles.
/// </summary>
internal sealed class ObjectBlock(GlResources resources, string name) : IDisposable
{
    private readonly GlBuffer _buffer = new(resources, $"matrix of {name}", BufferTarget.UniformBuffer);
    private readonly float[] _data = new float[36];
    private (AffineMap Map, Colour Colour, Colour Far, Vector Camera)? _lastKey;

    /// <summary>Binds the block, uploading it first where object or camera have moved since the last time.</summary>
    /// <param name="bindingPoint">As the program connects it.</param>
    /// <param name="map">From the drawn model's shifted frame to world space.</param>
    /// <param name="colour">sRGB.</param>
    /// <param name="gradientEnd">The other end of a gradient, sRGB; the same colour where there is none.</param>
    /// <param name="cameraPosition">World space.</param>
    public void Bind(int bindingPoint, AffineMap map, Colour colour, Colour gradientEnd, Vector cameraPosition)
    {
        if (resources.UploadFilter.Update(ref _lastKey, (map, colour, gradientEnd, cameraPosition)))
        {
            Write(map.Linear, 0);
            Write(NormalisedCofactors(map.Linear), 12);
            Write(map.Translation - cameraPosition, 24);
            var (red, green, blue) = colour.ToLinear();
            Write(new Vector(red, green, blue), 28);
            (red, green, blue) = gradientEnd.ToLinear();
            Write(new Vector(red, green, blue), 32);
            _buffer.Upload<float>(_data, BufferUsageHint.DynamicDraw);
        }

        _buffer.BindTo(bindingPoint);
    }

    /// <inheritdoc/>
    public void Dispose() => _buffer.Dispose();

    /// <summary>Scaled to entries of at most 1: only the direction of what it gives counts, and floats end at 1e38.</summary>
    private static Matrix NormalisedCofactors(Matrix linear)
    {
        var maxEntry = linear.MaxAbsEntry();
        var cofactors = maxEntry > 0 ? (linear / maxEntry).Cofactors() : linear;
        return cofactors.MaxAbsEntry() is > 0 and var scale ? cofactors / scale : cofactors;
    }

    private void Write(Matrix matrix, int start)
    {
        Write(matrix.V1, start);
        Write(matrix.V2, start + 4);
        Write(matrix.V3, start + 8);
    }

    private void Write(Vector v, int start) =>
        (_data[start], _data[start + 1], _data[start + 2]) = ((float)v.X, (float)v.Y, (float)v.Z);
}
