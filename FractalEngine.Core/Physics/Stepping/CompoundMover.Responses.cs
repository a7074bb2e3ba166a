using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Rows;

namespace FractalEngine.Core.Physics.Stepping;

/// <content>What a compound touches, and how it responds to what it meets.</content>
internal sealed partial class CompoundMover
{
    /// <summary>Takes away all approaches, by impulses that other bodies receive too.</summary>
    /// <returns>False where another body that is awake stays in touch.</returns>
    private bool TryRespond(Body body)
    {
        WakeWhatIsHit(body);
        CollectRows(body, withAwake: true);
        if (_rows.Count == 0)
        {
            return true;
        }

        _planner.StopApproachesOf(CollectionsMarshal.AsSpan(_members),
            CollectionsMarshal.AsSpan(_rows));
        foreach (ref readonly var row in CollectionsMarshal.AsSpan(_rows))
        {
            if (row.Second >= 0 && !IsSeparating(body, in row))
            {
                return false;
            }
        }

        return true;
    }

    private bool IsSeparating(Body body, in ContactRow row)
    {
        var velocity = body.VelocityAt(row.FirstArm) - _bodies[row.Second].VelocityAt(row.SecondArm);
        return Vector.Dot(velocity, row.Normal) > 0.5 * body.RestitutionThreshold;
    }

    private void WakeWhatIsHit(Body body)
    {
        for (var i = 0; i < body.Balls.Length; i++)
        {
            var contacts = body.Balls[i].Contacts;
            for (var j = 0; j < contacts.Count; j++)
            {
                var contact = contacts[j];
                var approach = -Vector.Dot(body.VelocityAt(body.Balls[i].Offset), contact.Normal(body.BallCentre(i)));
                if (contact.IsBody && _bodies[contact.BodyIndex].IsAsleep && approach > body.RestitutionThreshold)
                {
                    _islands.Wake(_bodies[contact.BodyIndex]);
                }
            }
        }
    }

    /// <summary>Makes contacts of all that the balls touch or may meet.</summary>
    private void CollectRows(Body body, bool withAwake)
    {
        _rows.Clear();
        _members.Clear();
        _members.Add(body.Index);
        for (var i = 0; i < body.Balls.Length; i++)
        {
            var ball = body.Balls[i];
            for (var j = 0; j < ball.Contacts.Count; j++)
            {
                var contact = ball.Contacts[j];
                if (!contact.IsBody)
                {
                    _rows.Add(ContactRows.OfSurface(body, i, in contact, isAhead: false));
                    continue;
                }

                var other = _bodies[contact.BodyIndex];
                var isImmovable = other.IsAsleep || other.IsStuck;
                if (isImmovable || withAwake)
                {
                    var row = new ContactRow();
                    ContactRows.SetBalls(ref row, body, i, other, FindBall(other, contact.Point), isImmovable, isAhead: false);
                    _rows.Add(row);
                    if (!isImmovable && !_members.Contains(other.Index))
                    {
                        _members.Add(other.Index);
                    }
                }
            }

            for (var j = 0; j < ball.NearSurfaces.Count; j++)
            {
                _rows.Add(ContactRows.OfNearSurface(body, i, in ball.NearSurfaces[j]));
            }
        }

        if (body.Description.Shape!.IsCapsule)
        {
            CollectionsMarshal.SetCount(_rows, CapsuleRows.RemoveInner(CollectionsMarshal.AsSpan(_rows)));
        }
    }

    private static int FindBall(Body body, Vector centre)
    {
        var closest = 0;
        for (var i = 1; i < body.BallCount; i++)
        {
            closest = (body.BallCentre(i) - centre).LengthSquared() < (body.BallCentre(closest) - centre).LengthSquared() ? i : closest;
        }

        return closest;
    }
}
