using System.Runtime.CompilerServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Simplification;

/// <summary>
/// A sum of squared distances from weighted planes, as a polynomial of the position (M. Garland, P. Heckbert, "Surface simplification using
/// quadric error metrics", 1997): dᵀ·A·d + 2·b·d + c, with A symmetric and d from an origin that its owner knows.
/// </summary>
/// <remarks>With its origin at the vertex that it belongs to, nothing cancels where a mesh is far from the origin of the scene.</remarks>
/// <param name="Squares">A, the sum of the normals' outer products.</param>
/// <param name="Linear">b.</param>
/// <param name="Constant">c, the sum at the origin.</param>
internal readonly record struct Quadric(Matrix Squares, Vector Linear, double Constant)
{
    // Added to A, which is scaled to a trace of 1: the condition number of the sum is below 1e7.
    private const double Regularization = 1e-6;

    // What a step leaves of the way in a direction of eigenvalue e is 1e-6/(e + 1e-6).
    private const int Steps = 4;

    // A smaller trace has no reciprocal.
    private const double MinWeight = 1e-300;

    /// <summary>Sum of the weights of all planes: the trace of A.</summary>
    public double Weight => Squares.V1.X + Squares.V2.Y + Squares.V3.Z;

    /// <summary>Makes the quadric of a plane through the origin.</summary>
    /// <param name="normal">Unit normal.</param>
    /// <param name="weight">Weight of the squared distance.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Quadric Plane(Vector normal, double weight) => new(weight * Matrix.Outer(normal, normal), Vector.Zero, 0);

    /// <summary>Adds two quadrics with the same origin.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Quadric operator +(in Quadric q1, in Quadric q2) =>
        new(q1.Squares + q2.Squares, q1.Linear + q2.Linear, q1.Constant + q2.Constant);

    /// <summary>Multiplies all weights by a number.</summary>
    public static Quadric operator *(double factor, in Quadric q) => new(factor * q.Squares, factor * q.Linear, factor * q.Constant);

    /// <summary>Moves the origin of the polynomial to another position.</summary>
    /// <param name="offset">From the present origin to the new one.</param>
    public Quadric WithOrigin(Vector offset) => new(Squares, Linear + (Squares * offset), ErrorAt(offset));

    /// <summary>Computes the sum of squared distances at a position; rounding makes it no less than 0.</summary>
    public double ErrorAt(Vector position) =>
        Math.Max(0, Vector.Dot(position, (Squares * position) + (2 * Linear)) + Constant);

    /// <summary>Finds the position with the smallest error.</summary>
    /// <param name="start">Where the planes leave a direction open, the result is as far along it as this position.</param>
    /// <remarks>
    /// Iterated Tikhonov regularization: each step solves with a matrix that can always be inverted, and the next corrects what that
    /// left. Directions that are all but open are followed in part.
    /// </remarks>
    public Vector Minimize(Vector start)
    {
        var weight = Weight;
        if (!(weight > MinWeight))
        {
            return start;
        }

        var (v1, v2, v3) = (Squares / weight) + (Regularization * Matrix.Identity);
        var cofactors = new Matrix(Vector.Cross(v2, v3), Vector.Cross(v3, v1), Vector.Cross(v1, v2));
        var inverse = cofactors / Vector.Dot(v1, cofactors.V1);
        var position = start;
        for (var step = 0; step < Steps; step++)
        {
            position -= inverse * (((Squares * position) + Linear) / weight);
        }

        return position;
    }
}
