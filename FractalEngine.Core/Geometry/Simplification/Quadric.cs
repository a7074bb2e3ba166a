using System.Runtime.CompilerServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Simplification;

/// <summary>
/// A sum of squared distances from weighted planes, as a polynomial of the position (M. Garland, P. Heckbert, "Surface simplification using
/// quadric error metrics", 1997): dᵀ·A·d + 2·b·d + c, with A symmetric and d from an origin that its owner knows.
/// </summary>
/// <remarks>With its origin at the vertex that it belongs to, nothing cancels where a mesh is far from the origin of the scene.</remarks>
/// <param name="Squares">Diagonal of A: coefficients of x², y², z².</param>
/// <param name="Products">Coefficients of yz, zx, xy in A, each of which A has twice.</param>
/// <param name="Linear">b.</param>
/// <param name="Constant">c, the sum at the origin.</param>
internal readonly record struct Quadric(Vector Squares, Vector Products, Vector Linear, double Constant)
{
    // Added to A, which is scaled to a trace of 1: the condition number of the sum is below 1e7.
    private const double Regularization = 1e-6;

    // What a step leaves of the way in a direction of eigenvalue e is 1e-6/(e + 1e-6).
    private const int Steps = 4;

    // A smaller trace has no reciprocal.
    private const double MinWeight = 1e-300;

    /// <summary>Sum of the weights of all planes: the trace of A.</summary>
    public double Weight => Squares.X + Squares.Y + Squares.Z;

    /// <summary>Makes the quadric of a plane through the origin.</summary>
    /// <param name="normal">Unit normal.</param>
    /// <param name="weight">Weight of the squared distance.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Quadric Plane(Vector normal, double weight) => new(
        weight * normal.Stretch(normal),
        weight * new Vector(normal.Y * normal.Z, normal.Z * normal.X, normal.X * normal.Y),
        Vector.Zero,
        0);

    /// <summary>Adds two quadrics with the same origin.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Quadric operator +(in Quadric q1, in Quadric q2) =>
        new(q1.Squares + q2.Squares, q1.Products + q2.Products, q1.Linear + q2.Linear, q1.Constant + q2.Constant);

    /// <summary>Multiplies all weights by a number.</summary>
    public static Quadric operator *(double factor, in Quadric q) =>
        new(factor * q.Squares, factor * q.Products, factor * q.Linear, factor * q.Constant);

    /// <summary>Moves the origin of the polynomial to another position.</summary>
    /// <param name="offset">From the present origin to the new one.</param>
    public Quadric WithOrigin(Vector offset) => new(Squares, Products, Linear + Multiply(offset), ErrorAt(offset));

    /// <summary>Computes the sum of squared distances at a position; rounding makes it no less than 0.</summary>
    public double ErrorAt(Vector position) =>
        Math.Max(0, Vector.Dot(position, Multiply(position) + (2 * Linear)) + Constant);

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

        var (squares, products) = (Squares / weight, Products / weight);
        var row1 = new Vector(squares.X + Regularization, products.Z, products.Y);
        var row2 = new Vector(products.Z, squares.Y + Regularization, products.X);
        var row3 = new Vector(products.Y, products.X, squares.Z + Regularization);
        var (column1, column2, column3) = (Vector.Cross(row2, row3), Vector.Cross(row3, row1), Vector.Cross(row1, row2));
        var determinant = Vector.Dot(row1, column1) * weight;
        var position = start;
        for (var step = 0; step < Steps; step++)
        {
            var slope = (Multiply(position) + Linear) / determinant;
            position -= (slope.X * column1) + (slope.Y * column2) + (slope.Z * column3);
        }

        return position;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private Vector Multiply(Vector v) => Squares.Stretch(v) + new Vector(
        (Products.Z * v.Y) + (Products.Y * v.Z),
        (Products.Z * v.X) + (Products.X * v.Z),
        (Products.Y * v.X) + (Products.X * v.Y));
}
