#:project ../FractalEngine.Core/FractalEngine.Core.csproj
#:property PublishAot=false
// A lift carries a ball past a trigger. Contacts are reported with their impulses; then a ray and a sphere look at the world.
using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Events;

var world = new PhysicsWorld(new PhysicsSettings { ReportsContacts = true });
var lift = world.AddStatic(Shapes.Cube(), Transformation.At(new(0, -0.5, 0)));
var gate = world.AddStatic(Shapes.Cube(), Transformation.At(new(0, 2, 0)));
gate.IsTrigger = true;
var ball = world.AddSphere(new(0, 1.25, 0), radius: 0.25, friction: 0.5, mass: 2);
lift.SetMotion(new(0, 1, 0));
for (var step = 0; step < 240; step++)
{
    world.Step();
    foreach (var contact in world.ContactEvents.Where(contact => contact.Phase != ContactPhase.Stay))
    {
        var name = contact.StaticObject == lift ? "lift" : "gate";
        Console.WriteLine(FormattableString.Invariant($"{world.Time:F2} s: {contact.Phase} {name}, impulse {contact.Impulse:F3}"));
    }
}

world.ApplyImpulse(ball, new(0, 0, 1), ball.Position + new Vector(0, 0.1, 0));
Console.WriteLine(FormattableString.Invariant($"speed {ball.Velocity.Length():F3}, spin {ball.AngularVelocity.Length():F1}"));
world.TryCastRay(new(new(5, 4.1, 0), new(-1, 0, 0)), out var seen);
world.TryCastSphere(new(0.3, 9, 0), 0.5, new(0, -9, 0), out var met);
Console.WriteLine(FormattableString.Invariant($"the ray meets the ball {seen.Body == ball}; the sphere gets {met.Distance:F2} far"));

// Output:
// 0.37 s: Begin lift, impulse 9.187
// 1.00 s: Begin gate, impulse 0.000
// 2.50 s: End gate, impulse 0.000
// speed 1.118, spin 2.0
// the ray meets the ball True; the sphere gets 4.06 far
